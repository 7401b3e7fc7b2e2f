#include <ddacontact/scene/key.hpp>
#include <ddacontact/scene/outline_check.hpp>
#include <ddacontact/scene/text.hpp>

#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/predicates.hpp>
#include <polyfem/geometry/validity.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ddacontact::scene_format {

namespace {

using polyfem::DefectiveVertex;
using polyfem::Index;
using polyfem::PolygonDefect;

/// Sine of the turning angle below which a corner is straight.
constexpr double straight_turn = 1e-9;
/// Two successive vertices nearer than this times the size of the block are one.
constexpr double repeated_distance = 1e-13;

struct Complaint {
  int vertex = -1;  ///< -1: the outline as a whole
  std::string what, cure;
};

std::string number(Index k) {
  return std::to_string(k);
}

Complaint complaint_about(const DefectiveVertex& found, Index n) {
  switch (found.defect) {
    case PolygonDefect::too_few_vertices:
      return {-1, "has " + number(n) + " vertices", "a polygon has at least three"};
    case PolygonDefect::not_finite:
      return {found.vertex, "has a vertex that is not finite", "write a finite number"};
    case PolygonDefect::repeated_vertex:
      return {found.other, "repeats vertex " + number(found.vertex) + " as vertex " + number(found.other),
              "write each vertex once; the polygon closes itself"};
    case PolygonDefect::zero_area:
      return {-1, "has zero area: all its vertices lie on one line", "move a vertex"};
    case PolygonDefect::self_intersection:
      break;
  }
  return {found.other,
          "intersects itself: edges " + number(found.vertex) + " and " + number(found.other) + " meet",
          "list the vertices in the order of the outline"};
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
  const Index n = polygon.cols();
  const Vec2 before = polygon.col((vertex + n - 1) % n), corner = polygon.col(vertex),
             after = polygon.col((vertex + 1) % n);
  const Vec2 in = corner - before, out = after - corner;
  const bool straight = std::abs(polyfem::cross(in, out)) <= straight_turn * in.norm() * out.norm();
  if (straight)
    return {name, "has a straight corner at vertex " + number(name),
            "leave that vertex out: vertices on an edge need the model \"mean_value\", which is not "
            "available in this version"};
  return {name, "has a concave corner at vertex " + number(name),
          "split the block into convex ones: concave blocks need the model \"mean_value\", which is not "
          "available in this version"};
}

/// The vertex's place, but the setting's where one changed any vertex.
const Place& place_of_vertex(const Outline& outline, int vertex, const Places& places) {
  for (const Place& place : outline.places)
    if (place.source != places.table.source) return place;
  if (vertex < 0 || places.of("vertices").source != places.table.source) return places.of("vertices");
  return outline.places[vertex];
}

}  // namespace

double CheckedOutline::distance_outside(const Vec2& point) const {
  if (polyfem::contains(polygon, point)) return 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (Index k = 0; k < polygon.cols(); ++k) {
    const Vec2 start = polygon.col(k), edge = polygon.col((k + 1) % polygon.cols()) - start;
    const double along = std::clamp(edge.dot(point - start) / edge.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (start + along * edge - point).norm());
  }
  return nearest;
}

CheckedOutline check_outline(const Outline& outline, const Places& places, const std::string& title,
                             ProblemList& problems) {
  const Index n = outline.points.cols();
  const auto refuse = [&](const Complaint& complaint) {
    problems.error(place_of_vertex(outline, complaint.vertex, places), title + ' ' + complaint.what,
                   complaint.cure);
    return CheckedOutline{};
  };
  if (n > most_vertices)
    return refuse(
        {-1, "has " + number(n) + " vertices", "at most " + number(most_vertices) + " are possible"});
  if (const auto defect = polyfem::find_defect(outline.points)) return refuse(complaint_about(*defect, n));

  CheckedOutline checked;
  const double area = polyfem::signed_area(outline.points);
  checked.size = std::sqrt(std::abs(area));
  if (std::abs(area) < smallest_positive * smallest_positive)
    return refuse({-1, "has an area of " + rounded(std::abs(area)) + " m2, next to zero", "move a vertex"});
  if (const auto complaint = find_short_edge(outline.points, checked.size)) return refuse(*complaint);

  const bool clockwise = area < 0;
  checked.polygon = outline.points;
  if (clockwise) checked.polygon = outline.points.rowwise().reverse();
  if (const auto corner = polyfem::find_non_convex_corner(checked.polygon, straight_turn))
    return refuse(
        corner_complaint(checked.polygon, *corner, clockwise ? static_cast<int>(n) - 1 - *corner : *corner));
  checked.turned = clockwise;
  return checked;
}

}  // namespace ddacontact::scene_format
