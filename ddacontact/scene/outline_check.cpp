#include <ddacontact/scene/key.hpp>
#include <ddacontact/scene/outline_check.hpp>
#include <ddacontact/scene/outline_distance.hpp>
#include <ddacontact/scene/text.hpp>

#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/predicates.hpp>
#include <polyfem/geometry/validity.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact::scene_format {

namespace {

using polyfem::DefectiveVertex;
using polyfem::PolygonDefect;

/// Two successive vertices nearer than this times the size of the block are one.
constexpr double repeated_distance = 1e-13;

struct Complaint {
  int vertex = -1;  ///< -1: the outline as a whole
  std::string what, cure;
};

std::string number(Index k) {
  return std::to_string(k);
}

/// The vertices of a polygon, counted around as often as one likes.
class Around {
 public:
  explicit Around(const Points& polygon) : polygon_(polygon) {}
  int n() const { return static_cast<int>(polygon_.cols()); }
  int index(int k) const { return (k + n()) % n(); }
  Vec2 operator()(int k) const { return polygon_.col(index(k)); }
  double length(int edge) const { return ((*this)(edge + 1) - (*this)(edge)).norm(); }

 private:
  const Points& polygon_;
};

/// The first vertex at which an edge runs back along the one before.
std::optional<Complaint> find_fold(const Around& vertex) {
  for (int k = 0; k < vertex.n(); ++k) {
    const Vec2 in = vertex(k) - vertex(k - 1), out = vertex(k + 1) - vertex(k);
    if (in.dot(out) < 0 && polyfem::orientation(vertex(k - 1), vertex(k), vertex(k + 1)) == 0)
      return Complaint{k,
                       "runs back on itself at vertex " + number(k) + " over " +
                           rounded(std::min(in.norm(), out.norm())) + " m",
                       "leave that vertex out"};
  }
  return std::nullopt;
}

/// The first of the four ends of two edges that lies on the other edge.
std::optional<Complaint> find_touch(const Around& vertex, int edge, int other) {
  const auto on = [&](int k, int e) -> std::optional<Complaint> {
    if (!polyfem::on_segment(vertex(e), vertex(e + 1), vertex(k))) return std::nullopt;
    return Complaint{vertex.index(k),
                     "touches itself: vertex " + number(vertex.index(k)) + " lies on edge " + number(e),
                     "move the vertex off that edge, or split the block there"};
  };
  for (const int k : {other, other + 1})
    if (const auto found = on(k, edge)) return found;
  for (const int k : {edge, edge + 1})
    if (const auto found = on(k, other)) return found;
  return std::nullopt;
}

Complaint complaint_about_crossing(const Around& vertex, int edge, int other) {
  if (const auto fold = find_fold(vertex)) return *fold;
  if (const auto touch = find_touch(vertex, edge, other)) return *touch;
  const Vec2 along = vertex(edge + 1) - vertex(edge), across = vertex(other + 1) - vertex(other);
  const Vec2 at = vertex(edge) + polyfem::cross(vertex(other) - vertex(edge), across) /
                                     polyfem::cross(along, across) * along;
  return {other,
          "intersects itself: edges " + number(edge) + " and " + number(other) + " cross at (" +
              rounded(at.x()) + ", " + rounded(at.y()) + ")",
          "list the vertices in the order of the outline"};
}

Complaint complaint_about(const DefectiveVertex& found, const Points& polygon) {
  const int n = static_cast<int>(polygon.cols()), first = found.vertex, second = found.other;
  switch (found.defect) {
    case PolygonDefect::too_few_vertices:
      return {-1, "has " + number(n) + " vertices", "a polygon has at least three"};
    case PolygonDefect::not_finite:
      return {first, "has a vertex that is not finite", "write a finite number"};
    case PolygonDefect::repeated_vertex:
      if (second == first + 1 || (first == 0 && second == n - 1))
        return {second, "repeats vertex " + number(first) + " as vertex " + number(second),
                "write each vertex once; the polygon closes itself"};
      return {second,
              "touches itself: vertex " + number(second) + " is at the place of vertex " + number(first),
              "move one of them, or split the block there"};
    case PolygonDefect::zero_area:
      return {-1, "has zero area: all its vertices lie on one line", "move a vertex"};
    case PolygonDefect::self_intersection:
      break;
  }
  return complaint_about_crossing(Around(polygon), first, second);
}

/// The nearest that a vertex comes to an edge which is not its own, unless that is far enough.
std::optional<Complaint> find_narrow_place(const Points& polygon, double size, BlockModel model) {
  const Around vertex(polygon);
  const int n = vertex.n();
  const double part = model == BlockModel::mesh ? narrowest_of_mesh : narrowest, limit = part * size;
  double nearest = limit;
  int at = -1, of = -1;
  for (int k = 0; k < n; ++k) {
    const int past = vertex.length(k) > limit ? k + 1 : k + 2;
    const int before = vertex.length(vertex.index(k - 1)) > limit ? k - 1 : k - 2;
    for (int e = past; e < before + n; ++e) {
      const double distance = distance_to_edge(vertex(k), vertex(e), vertex(e + 1));
      if (distance >= nearest) continue;
      nearest = distance;
      at = k;
      of = vertex.index(e);
    }
  }
  if (at < 0) return std::nullopt;
  return Complaint{
      at, "passes at vertex " + number(at) + " within " + rounded(nearest) + " m of edge " + number(of),
      "widen it beyond " + rounded(limit) + " m, " + (model == BlockModel::mesh ? "1e-6" : "1e-9") +
          " of the size" + (model == BlockModel::mesh ? ", as cells need" : "") +
          ", or leave the vertex out"};
}

std::optional<Complaint> find_short_edge(const Points& polygon, double size) {
  const Index n = polygon.cols();
  for (Index k = 0; k < n; ++k)
    if ((polygon.col((k + 1) % n) - polygon.col(k)).norm() <= repeated_distance * size)
      return Complaint{static_cast<int>(k),
                       "has vertices " + number(k) + " and " + number((k + 1) % n) + " at the same place",
                       "leave one of them out"};
  return std::nullopt;
}

/// `vertex` counts along the counter-clockwise polygon, `name` as in the file.
Complaint corner_complaint(const Points& polygon, int vertex, int name) {
  const Around around(polygon);
  const Vec2 in = around(vertex) - around(vertex - 1), out = around(vertex + 1) - around(vertex);
  const bool straight = std::abs(polyfem::cross(in, out)) <= straight_turn * in.norm() * out.norm();
  return {name,
          std::string("has a ") + (straight ? "straight" : "concave") + " corner at vertex " + number(name) +
              ", which the model \"wachspress\" cannot have",
          straight ? "write model = \"mean_value\" or \"mesh\", or leave that vertex out"
                   : "write model = \"mean_value\" or \"mesh\", or split the block with dda cut --convex"};
}

/// The vertex's place, but the setting's where one changed any vertex.
const SourceLocation& location_of_vertex(const Outline& outline, int vertex, const KeyLocations& locations) {
  for (const SourceLocation& location : outline.locations)
    if (location.source != locations.table.source) return location;
  if (vertex < 0 || outline.locations.empty() || locations.of("vertices").source != locations.table.source)
    return locations.of("vertices");
  return outline.locations[vertex];
}

}  // namespace

double CheckedOutline::distance_outside(const Vec2& point) const {
  return polyfem::distance_outside(polygon, point);
}

void check_simple(const Outline& outline, const SourceLocation& location, const std::string& title,
                  ProblemList& problems) {
  const auto defect = polyfem::find_defect(outline.points);
  if (!defect) return;
  const Complaint complaint = complaint_about(*defect, outline.points);
  const bool is_placed = complaint.vertex >= 0 && !outline.locations.empty();
  problems.error(is_placed ? outline.locations[complaint.vertex] : location, title + ' ' + complaint.what,
                 complaint.cure);
}

CheckedOutline check_outline(const Outline& outline, BlockModel model, const KeyLocations& locations,
                             const std::string& title, ProblemList& problems) {
  const Index n = outline.points.cols();
  const auto refuse = [&](const Complaint& complaint) {
    problems.error(location_of_vertex(outline, complaint.vertex, locations), title + ' ' + complaint.what,
                   complaint.cure);
    return CheckedOutline{};
  };
  if (n > most_vertices)
    return refuse(
        {-1, "has " + number(n) + " vertices", "at most " + number(most_vertices) + " are possible"});
  if (const auto defect = polyfem::find_defect(outline.points))
    return refuse(complaint_about(*defect, outline.points));

  CheckedOutline checked;
  const double area = polyfem::signed_area(outline.points);
  checked.size = std::sqrt(std::abs(area));
  if (std::abs(area) < smallest_positive * smallest_positive)
    return refuse({-1, "has an area of " + rounded(std::abs(area)) + " m2, next to zero", "move a vertex"});
  if (const auto complaint = find_short_edge(outline.points, checked.size)) return refuse(*complaint);

  const bool clockwise = area < 0;
  checked.polygon = outline.points;
  if (clockwise) checked.polygon = outline.points.rowwise().reverse();
  const auto corner = model == BlockModel::wachspress
                          ? polyfem::find_non_convex_corner(checked.polygon, straight_turn)
                          : std::nullopt;
  if (corner)
    return refuse(
        corner_complaint(checked.polygon, *corner, clockwise ? static_cast<int>(n) - 1 - *corner : *corner));
  if (const auto complaint = find_narrow_place(outline.points, checked.size, model))
    return refuse(*complaint);
  checked.turned = clockwise;
  return checked;
}

}  // namespace ddacontact::scene_format
