#include <polyfem/mesh/voronoi.hpp>

#include <polyfem/core/error.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/corner_turn.hpp>
#include <polyfem/geometry/validity.hpp>
#include <polyfem/mesh/boundary_positions.hpp>
#include <polyfem/mesh/clipped_diagram.hpp>
#include <polyfem/mesh/convex_cuts.hpp>
#include <polyfem/mesh/local_frame.hpp>
#include <polyfem/mesh/mesh_editor.hpp>
#include <polyfem/mesh/short_edges.hpp>
#include <polyfem/mesh/sites.hpp>
#include <polyfem/mesh/straight_corners.hpp>
#include <polyfem/mesh/weld.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

namespace polyfem {

namespace {

/// Sines of turning angles: what corners are bent to, what a cell is cut for at last, what it must have, and
/// what of the domain counts as round-off.
constexpr double wanted_turn = 0.0523, accepted_turn = 0.01, tolerated_turn = 1e-3, required_turn = 1e-6,
                 straight_turn = 1e-12;
/// Below this a corner is concave beyond the round-off of a very short edge.
constexpr double concave_turn = -1e-2;
/// In units of the size of a cell: corners nearer than this are one.
constexpr double weld_distance = 1e-9;

/// Area of a domain relative to the square of its length, below which numbers run out.
constexpr double thinnest = 1e-10;

void check(const VoronoiOptions& options) {
  if (options.n_cells < 1 || options.n_cells > 10'000'000)
    throw Error("the number of cells must be 1 to 10000000, not " + std::to_string(options.n_cells));
  if (options.lloyd_steps < 0)
    throw Error("the number of Lloyd steps must be at least 0, not " + std::to_string(options.lloyd_steps));
  if (!(options.smallest_edge >= 0 && options.smallest_edge <= 0.3))
    throw Error("the smallest edge must be 0 to 0.3 of a cell's size, not " +
                std::to_string(options.smallest_edge));
}

std::string words(const DefectiveVertex& found) {
  const std::string vertex = std::to_string(found.vertex), other = std::to_string(found.other);
  switch (found.defect) {
    case PolygonDefect::too_few_vertices:
      return "has fewer than three vertices";
    case PolygonDefect::not_finite:
      return "has vertex " + vertex + " that is not finite";
    case PolygonDefect::repeated_vertex:
      return "repeats vertex " + vertex + " as vertex " + other;
    case PolygonDefect::zero_area:
      return "has zero area";
    case PolygonDefect::self_intersection:
      break;
  }
  return "intersects itself: edges " + vertex + " and " + other + " meet";
}

/// The domain counter-clockwise, without corners that are straight to round-off.
Points prepared(const PointsRef& domain) {
  if (const auto defect = find_defect(domain)) throw Error("the domain " + words(*defect));
  const double area = signed_area(domain);
  const double length = (domain.rowwise().maxCoeff() - domain.rowwise().minCoeff()).norm();
  if (!std::isfinite(area) || !(std::abs(area) > thinnest * length * length))
    throw Error("the domain is too thin or too large to be divided");
  const bool clockwise = area < 0;
  Points polygon = domain;
  if (clockwise) polygon = domain.rowwise().reverse();
  std::vector<Index> kept;
  const Index n = polygon.cols();
  for (Index k = 0; k < n; ++k)
    if (std::abs(turn_sine(polygon.col((k + n - 1) % n), polygon.col(k), polygon.col((k + 1) % n))) >
        straight_turn)
      kept.push_back(k);
  return polygon(Eigen::all, kept);
}

/// All in local coordinates.
struct LocalMesh {
  PolygonMesh mesh;
  std::vector<BoundaryPosition> positions;
};

LocalMesh local_voronoi(const Points& domain, double cell_size, const VoronoiOptions& options) {
  Points sites = random_sites(domain, options.n_cells, options.seed);
  for (int step = 0; step < options.lloyd_steps; ++step) sites = lloyd_step(domain, sites);
  PolygonMesh mesh = weld(clipped_voronoi_diagram(domain, sites), weld_distance * cell_size);
  std::vector<BoundaryPosition> positions = boundary_positions(mesh, domain, weld_distance * cell_size);
  MeshEditor editor(cut_into_convex(mesh, concave_turn), std::move(positions), domain);
  for (const double turn : {wanted_turn, wanted_turn, accepted_turn}) {
    collapse_short_edges(editor, options.smallest_edge * cell_size, turn, options.n_cells);
    bend_straight_corners(editor, wanted_turn);
  }
  return {cut_into_convex(editor.mesh(), tolerated_turn), editor.positions()};
}

/// Cells row by row, see the header.
std::vector<int> cell_order(const PolygonMesh& mesh, double row_height) {
  struct Place {
    double row, x, y;
    int cell;
    auto key() const { return std::tie(row, x, y, cell); }
  };
  std::vector<Place> positions;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const Vec2 centroid = area_moments(mesh.outline(c)).centroid;
    positions.push_back({std::floor(centroid.y() / row_height), centroid.x(), centroid.y(), c});
  }
  std::sort(positions.begin(), positions.end(),
            [](const Place& a, const Place& b) { return a.key() < b.key(); });
  std::vector<int> order;
  for (const Place& position : positions) order.push_back(position.cell);
  return order;
}

/// Vertices on the outline are placed anew on its edges, so that they are as near to them as doubles allow.
Vec2 world_vertex(const Vec2& local, const BoundaryPosition& position, const Points& local_domain,
                  const Points& domain, const LocalFrame& frame) {
  if (position.corner >= 0) return domain.col(position.corner);
  if (position.edge < 0) return frame.to_world(local);
  const Index next = (position.edge + 1) % domain.cols();
  const Vec2 edge = local_domain.col(next) - local_domain.col(position.edge);
  const double along = edge.dot(local - local_domain.col(position.edge)) / edge.squaredNorm();
  return domain.col(position.edge) + along * (domain.col(next) - domain.col(position.edge));
}

}  // namespace

PolygonMesh voronoi(const PointsRef& domain, const VoronoiOptions& options) {
  check(options);
  const Points outline = prepared(domain);
  const double world_size = std::sqrt(signed_area(outline) / options.n_cells);
  const LocalFrame frame(outline.rowwise().minCoeff(), world_size);
  const Points local_outline = frame.to_local(outline);
  const double cell_size = std::sqrt(signed_area(local_outline) / options.n_cells);
  const LocalMesh local = local_voronoi(local_outline, cell_size, options);

  PolygonMesh result;
  std::vector<int> new_index(local.positions.size(), -1), corners, used;
  for (const int c : cell_order(local.mesh, cell_size)) {
    corners.clear();
    for (const int v : local.mesh.cell(c)) {
      if (new_index[v] < 0) {
        new_index[v] = static_cast<int>(used.size());
        used.push_back(v);
      }
      corners.push_back(new_index[v]);
    }
    result.add_cell(corners);
  }
  result.vertices.resize(2, static_cast<Index>(used.size()));
  for (std::size_t i = 0; i < used.size(); ++i)
    result.vertices.col(static_cast<Index>(i)) = world_vertex(
        local.mesh.vertices.col(used[i]), local.positions[used[i]], local_outline, outline, frame);
  for (int c = 0; c < result.n_cells(); ++c)
    if (find_non_convex_corner(result.outline(c), required_turn))
      throw Error("a Voronoi cell came out with a straight corner; another seed or number of cells may help");
  return result;
}

}  // namespace polyfem
