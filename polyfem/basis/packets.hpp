/// \file Shape functions at many points, a packet of `n_lanes` points at a time.
#pragma once

#include <polyfem/basis/basis.hpp>
#include <polyfem/basis/lanes.hpp>

#include <algorithm>

namespace polyfem {

/// Gives the table a row for each point and a column for each vertex.
inline void resize(ShapeTable& table, Index n_points, Index n_vertices) {
  for (MatrixXd* entries : {&table.values, &table.dx, &table.dy}) entries->resize(n_points, n_vertices);
}

/// `n_used` points from point q on; further lanes repeat the last of them.
inline LaneVector load(const PointsRef& points, Index q, Index n_used) {
  LaneVector x;
  for (Index lane = 0; lane < n_lanes; ++lane) {
    const Index point = q + std::min(lane, n_used - 1);
    x.x[lane] = points(0, point);
    x.y[lane] = points(1, point);
  }
  return x;
}

/// Calls `evaluate(x, row, table)` for all packets of points, which writes n_lanes rows from `row` on. A
/// point's results are the same whatever packet it is in: the last one is filled up.
template <class Evaluate>
void for_each_packet(const PointsRef& points, ShapeTable& table, Evaluate&& evaluate) {
  Index q = 0;
  for (; q + n_lanes <= points.cols(); q += n_lanes) evaluate(load(points, q, n_lanes), q, table);

  const Index n_left = points.cols() - q;
  if (n_left == 0) return;
  thread_local ShapeTable packet;
  resize(packet, n_lanes, table.n_vertices());
  evaluate(load(points, q, n_left), Index{0}, packet);
  table.values.bottomRows(n_left) = packet.values.topRows(n_left);
  table.dx.bottomRows(n_left) = packet.dx.topRows(n_left);
  table.dy.bottomRows(n_left) = packet.dy.topRows(n_left);
}

/// Rows from `row` on become those of the table of a packet where the mask does not hold.
inline void take_other_rows(const LaneMask& mask, const ShapeTable& packet, Index row, ShapeTable& table) {
  for (Index lane = 0; lane < n_lanes; ++lane) {
    if (mask[lane]) continue;
    table.values.row(row + lane) = packet.values.row(lane);
    table.dx.row(row + lane) = packet.dx.row(lane);
    table.dy.row(row + lane) = packet.dy.row(lane);
  }
}

}  // namespace polyfem
