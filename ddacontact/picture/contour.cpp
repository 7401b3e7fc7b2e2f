#include <ddacontact/picture/contour.hpp>

#include <algorithm>
#include <cstdint>

namespace ddacontact {

namespace {

/// A point of a region's boundary: a node (both the same) or where an edge between two nodes crosses the
/// level.
struct BoundaryPoint {
  int low = 0, high = 0;
  bool is_node() const { return low == high; }
  std::uint64_t key() const {
    return static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high);
  }
};

BoundaryPoint crossing(int a, int b) {
  return {std::min(a, b), std::max(a, b)};
}

/// A piece of a region's boundary, the region on its left.
struct Piece {
  BoundaryPoint from, to;
  bool used = false;
};

class Contours {
 public:
  Contours(const FanMesh& mesh, const Points& nodes, const VectorXd& values,
           const std::vector<double>& levels)
      : mesh_(mesh), nodes_(nodes), values_(values), levels_(levels), pieces_(levels.size()) {}

  std::vector<Region> regions() {
    mesh_.for_each_triangle([this](int a, int b, int c) { cut_triangle({a, b, c}); });
    for (int k = 0; k < mesh_.n_outline_nodes(); ++k)
      cut_outline(mesh_.outline_node(k), mesh_.outline_node(k + 1));
    std::vector<Region> regions;
    for (std::size_t k = 0; k < levels_.size(); ++k) regions.push_back(linked(pieces_[k], levels_[k]));
    return regions;
  }

 private:
  /// The first level above `value`: those before are reached.
  std::size_t n_reached(double value) const {
    return static_cast<std::size_t>(std::upper_bound(levels_.begin(), levels_.end(), value) -
                                    levels_.begin());
  }

  /// In a triangle the boundary runs from where going round leaves the region to where it enters again.
  void cut_triangle(const std::array<int, 3>& corners) {
    const double a = values_[corners[0]], b = values_[corners[1]], c = values_[corners[2]];
    const std::size_t last = n_reached(std::max({a, b, c}));
    for (std::size_t k = n_reached(std::min({a, b, c})); k < last; ++k) {
      Piece piece;
      for (std::size_t i = 0; i < 3; ++i) {
        const int here = corners[i], next = corners[(i + 1) % 3];
        const bool here_in = values_[here] >= levels_[k], next_in = values_[next] >= levels_[k];
        if (here_in && !next_in) piece.from = crossing(here, next);
        if (!here_in && next_in) piece.to = crossing(here, next);
      }
      pieces_[k].push_back(piece);
    }
  }

  void cut_outline(int here, int next) {
    const std::size_t here_reaches = n_reached(values_[here]), next_reaches = n_reached(values_[next]);
    for (std::size_t k = 0; k < std::max(here_reaches, next_reaches); ++k)
      pieces_[k].push_back({k < here_reaches ? BoundaryPoint{here, here} : crossing(here, next),
                            k < next_reaches ? BoundaryPoint{next, next} : crossing(here, next)});
  }

  Vec2 position(const BoundaryPoint& point, double level) const {
    if (point.is_node()) return nodes_.col(point.low);
    const double below = values_[point.low], above = values_[point.high];
    const double t = std::clamp((level - below) / (above - below), 0., 1.);
    return nodes_.col(point.low) + t * (nodes_.col(point.high) - nodes_.col(point.low));
  }

  /// Every point has one piece that leaves it and one that enters it, so the pieces make closed polygons.
  Region linked(std::vector<Piece>& pieces, double level) const {
    const auto before = [](const Piece& p, const Piece& q) { return p.from.key() < q.from.key(); };
    std::sort(pieces.begin(), pieces.end(), before);
    Region region;
    for (Piece& first : pieces) {
      if (first.used) continue;
      std::vector<Vec2> polygon;
      for (Piece* piece = &first; !piece->used;) {
        piece->used = true;
        const BoundaryPoint& point = piece->from;
        if (!point.is_node() || mesh_.is_corner(point.low)) polygon.push_back(position(point, level));
        piece = &*std::lower_bound(pieces.begin(), pieces.end(), Piece{piece->to, {}}, before);
      }
      region.push_back(std::move(polygon));
    }
    return region;
  }

  const FanMesh& mesh_;
  const Points& nodes_;
  const VectorXd& values_;
  const std::vector<double>& levels_;
  std::vector<std::vector<Piece>> pieces_;  ///< of each level
};

}  // namespace

std::vector<Region> superlevel_regions(const FanMesh& mesh, const Points& nodes, const VectorXd& values,
                                       const std::vector<double>& levels) {
  return Contours(mesh, nodes, values, levels).regions();
}

}  // namespace ddacontact
