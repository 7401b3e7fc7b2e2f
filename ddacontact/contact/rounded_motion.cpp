#include <ddacontact/contact/rounded_motion.hpp>

namespace ddacontact {

namespace {

/// From derivatives by a point tied to the segment from i, and by two tied to that from j to k, to those by the
/// vertices.
VertexEdgeGradient by_vertices(const VertexEdgeGradient& by_points, const SegmentPoint& of_vertex,
                               const SegmentPoint& one, const SegmentPoint& other) {
  const Vec2 by_after_i = of_vertex.by_q(by_points.i), by_k = one.by_q(by_points.j) + other.by_q(by_points.k);
  return {by_points.i - by_after_i, by_points.j + by_points.k - by_k, by_k, by_after_i};
}

/// The centre of the vertex's circle over the edge.
VertexEdgePositions centre_positions(const RoundedPositions& positions, const Rounding& rounding) {
  return {rounding.centre.at(positions.i, positions.after_i), positions.j, positions.k};
}

}  // namespace

VertexEdgePositions slip_positions(const RoundedPositions& positions, const Rounding& rounding) {
  return {rounding.surface.at(positions.i, positions.after_i), rounding.start.at(positions.j, positions.k),
          rounding.end.at(positions.j, positions.k)};
}

Vec2 from_corner(const RoundedPositions& positions, const Rounding& rounding) {
  return rounding.centre.at(positions.i, positions.after_i) -
         rounding.other_centre.at(positions.j, positions.k);
}

GapAndSlip gap_and_slip(const RoundedPositions& start, const RoundedPositions& by, double lock,
                        Directions directions, const Rounding& rounding) {
  // Places and motions go by the same linear map.
  const GapAndSlip of_surface =
      gap_and_slip(slip_positions(start, rounding), slip_positions(by, rounding), lock, directions);
  GapAndSlip result{0,
                    of_surface.slip,
                    {},
                    by_vertices(of_surface.by_slip, rounding.surface, rounding.start, rounding.end)};
  if (rounding.corner) {
    const Vec2 from = from_corner(start, rounding), change = from_corner(by, rounding), to = from + change;
    const double sum = from.norm() + to.norm();
    const Vec2 away = directions == Directions::mean
                          ? Vec2((from + to) / sum)
                          : (directions == Directions::of_start ? from : to).normalized();
    result.gap = from.norm() - rounding.radius + (from + to).dot(change) / sum;
    result.by_gap =
        by_vertices({away, -away, Vec2::Zero()}, rounding.centre, rounding.other_centre, SegmentPoint{});
  } else {
    const GapAndSlip of_centre =
        gap_and_slip(centre_positions(start, rounding), centre_positions(by, rounding), 0, directions);
    result.gap = of_centre.gap - rounding.radius;
    result.by_gap = by_vertices(of_centre.by_gap, rounding.centre, SegmentPoint{}, SegmentPoint{1, 0});
  }
  return result;
}

}  // namespace ddacontact
