#include <polyfem/mesh/line_noding.hpp>

#include <polyfem/core/error.hpp>
#include <polyfem/mesh/geos_context.hpp>
#include <polyfem/mesh/segment_grid.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <unordered_map>
#include <utility>

namespace polyfem {

namespace {

struct BitsOf {
  std::size_t operator()(const std::array<double, 2>& point) const {
    const std::hash<double> hash;
    return hash(point[0]) * 0x9E3779B97F4A7C15u ^ hash(point[1]);
  }
};

/// Gives equal points one number.
class VertexNumbers {
 public:
  explicit VertexNumbers(std::vector<Vec2>& vertices) : vertices_(vertices) {}
  int operator()(const Vec2& point) {
    const auto [entry, is_new] =
        numbers_.try_emplace({point.x() + 0.0, point.y() + 0.0}, static_cast<int>(vertices_.size()));
    if (is_new) vertices_.push_back(point);
    return entry->second;
  }

 private:
  std::vector<Vec2>& vertices_;
  std::unordered_map<std::array<double, 2>, int, BitsOf> numbers_;
};

/// In an order without rule: GEOS hangs crossings in a tree as it finds them, which those of rows of lines
/// one after another make as deep as a list.
std::vector<Segment> shuffled(std::vector<Segment> segments) {
  std::mt19937 random;
  for (std::size_t k = segments.size(); k > 1; --k) std::swap(segments[k - 1], segments[random() % k]);
  return segments;
}

GeosGeometry lines_of(const GeosContext& geos, const std::vector<Segment>& segments) {
  std::vector<GEOSGeometry*> lines;
  Points ends(2, 2);
  for (const Segment& segment : shuffled(segments)) {
    if (segment.from == segment.to) continue;
    ends << segment.from, segment.to;
    lines.push_back(geos.checked(GEOSGeom_createLineString_r(geos.handle(), coordinates(geos, ends))));
  }
  return own(geos, GEOSGeom_createCollection_r(geos.handle(), GEOS_MULTILINESTRING, lines.data(),
                                               static_cast<unsigned>(lines.size())));
}

double distance(const Segment& segment, const Vec2& point) {
  const Vec2 along = segment.to - segment.from, to_point = point - segment.from;
  const double t = std::clamp(along.dot(to_point) / along.squaredNorm(), 0.0, 1.0);
  return (to_point - t * along).norm();
}

/// The first segment within `reach` of a point, the nearest one where there is none.
int segment_at(const Vec2& point, const std::vector<Segment>& segments, const SegmentGrid& index,
               double reach) {
  int nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (const int k : index.near(point)) {
    const double d = distance(segments[k], point);
    if (d <= reach) return k;
    if (d < least) {
      least = d;
      nearest = k;
    }
  }
  return nearest;
}

/// Of a segment, between two nodes.
struct Piece {
  Vec2 from, to;
  int segment = 0;
  double along = 0;  ///< the segment, m

  auto place() const { return std::pair(segment, along); }
};

/// Those of all segments one after another, each along its segment.
std::vector<Piece> pieces_of(const std::vector<Segment>& segments, double grid) {
  const GeosContext geos("node the lines");
  const GeosGeometry lines = lines_of(geos, segments);
  const GeosGeometry noded = own(geos, GEOSUnaryUnionPrec_r(geos.handle(), lines.get(), grid));
  std::vector<Piece> pieces;
  const int n_lines = GEOSGetNumGeometries_r(geos.handle(), noded.get());
  for (int i = 0; i < n_lines; ++i) {
    const Points points = points_of(geos, geos.checked(GEOSGetGeometryN_r(geos.handle(), noded.get(), i)));
    for (Index k = 0; k + 1 < points.cols(); ++k)
      if (points.col(k) != points.col(k + 1)) pieces.push_back({points.col(k), points.col(k + 1)});
  }
  const SegmentGrid index(segments, static_cast<double>(pieces.size()));
  for (Piece& piece : pieces) {
    const Vec2 middle = (piece.from + piece.to) / 2;
    piece.segment = segment_at(middle, segments, index, 2 * grid);
    const auto& [from, to, mark] = segments[piece.segment];
    piece.along = (to - from).normalized().dot(middle - from);
    if ((to - from).dot(piece.to - piece.from) < 0) std::swap(piece.from, piece.to);
  }
  std::ranges::sort(pieces, {}, &Piece::place);
  return pieces;
}

NodedLines noded(const std::vector<Segment>& segments, double grid) {
  NodedLines result;
  result.grid = grid;
  VertexNumbers number(result.vertices);
  for (const Piece& piece : pieces_of(segments, grid)) {
    const int from = number(piece.from), to = number(piece.to);
    result.edges.push_back({from, to, segments[piece.segment].mark});
  }
  return result;
}

}  // namespace

double noding_grid(const PointsRef& points) {
  const Vec2 box = points.rowwise().maxCoeff() - points.rowwise().minCoeff();
  const int size = std::ilogb(box.maxCoeff()),
            distance_from_origin = std::ilogb(points.cwiseAbs().maxCoeff());
  return std::ldexp(1.0, std::max(size - 46, distance_from_origin - 50));
}

NodedLines node_lines(const std::vector<Segment>& segments, double grid) {
  constexpr int most_tries = 4;
  if (segments.empty()) return {{}, {}, grid};
  for (int tries = 1; tries < most_tries; ++tries, grid *= 16) {
    try {
      return noded(segments, grid);
    } catch (const Error&) {  // on a coarser grid then
    }
  }
  return noded(segments, grid);
}

}  // namespace polyfem
