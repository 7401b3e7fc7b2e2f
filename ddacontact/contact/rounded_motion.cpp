#include <ddacontact/contact/rounded_motion.hpp>

namespace ddacontact {

namespace {

VertexEdgePositions positions_of(const SegmentPoint& of_vertex, const RoundedPositions& positions,
                                 const Rounding& rounding) {
  return {of_vertex.at(positions.i, positions.after_i), rounding.start.at(positions.j, positions.k),
          rounding.end.at(positions.j, positions.k)};
}

/// From derivatives by the points that `positions_of` returns to those by the vertices.
VertexEdgeGradient by_vertices(const VertexEdgeGradient& by_points, const SegmentPoint& of_vertex,
                               const Rounding& rounding) {
  const Vec2 by_after_i = of_vertex.by_q(by_points.i),
             by_k = rounding.start.by_q(by_points.j) + rounding.end.by_q(by_points.k);
  return {by_points.i - by_after_i, by_points.j + by_points.k - by_k, by_k, by_after_i};
}

/// From where the other corner is, half way along the line of the slip.
Vec2 from_middle(const VertexEdgePositions& positions) {
  return positions.i - (positions.j + positions.k) / 2;
}

}  // namespace

VertexEdgePositions slip_positions(const RoundedPositions& positions, const Rounding& rounding) {
  return positions_of(rounding.surface, positions, rounding);
}

Vec2 from_corner(const RoundedPositions& positions, const Rounding& rounding) {
  return from_middle(positions_of(rounding.centre, positions, rounding));
}

GapAndSlip gap_and_slip(const RoundedPositions& start, const RoundedPositions& by, double lock,
                        Directions directions, const Rounding& rounding) {
  // Places and motions go by the same linear map.
  const VertexEdgePositions centre = positions_of(rounding.centre, start, rounding),
                            centre_by = positions_of(rounding.centre, by, rounding);
  const GapAndSlip of_surface =
      gap_and_slip(slip_positions(start, rounding), slip_positions(by, rounding), lock, directions);
  GapAndSlip result{0, of_surface.slip, {}, by_vertices(of_surface.by_slip, rounding.surface, rounding)};
  VertexEdgeGradient by_centres;
  if (rounding.corner) {
    const Vec2 from = from_middle(centre), change = from_middle(centre_by), to = from + change;
    const double sum = from.norm() + to.norm();
    const Vec2 away = directions == Directions::mean
                          ? Vec2((from + to) / sum)
                          : (directions == Directions::of_start ? from : to).normalized();
    result.gap = from.norm() - rounding.radius + (from + to).dot(change) / sum;
    by_centres = {away, -away / 2, -away / 2};
  } else {
    const GapAndSlip of_centre = gap_and_slip(centre, centre_by, 0, directions);
    result.gap = of_centre.gap - rounding.radius;
    by_centres = of_centre.by_gap;
  }
  result.by_gap = by_vertices(by_centres, rounding.centre, rounding);
  return result;
}

}  // namespace ddacontact
