#include <polyfem/basis/mean_value_far.hpp>

#include <algorithm>
#include <cmath>

namespace polyfem {
namespace {

/// Of the size of a polygon: far from a vertex, and the length of edges that are not short. Gradients err by
/// a few eps over it.
constexpr double far = 1. / 32;
/// The half tangent of the angle at which an edge is seen from points that are far from it. Weights err by
/// eps times it.
constexpr double largest_half_tangent = 16;

/// The angle at which the point sees an edge.
struct Angle {
  Lanes t;            ///< tan(angle / 2)
  LaneVector change;  ///< grad t, turned left
};

}  // namespace

bool MeanValueFarFromBoundary::set(const PointsRef& polygon) {
  const Index n = polygon.cols();
  const double least = far * (polygon.rowwise().maxCoeff() - polygon.rowwise().minCoeff()).maxCoeff();
  largest_inverse_ = 1 / least;
  corners_.resize(static_cast<std::size_t>(n));
  vertices_.resize(corners_.size());
  weights_.resize(corners_.size());
  for (Index i = 0; i < n; ++i) {
    const Vec2 from = polygon.col(i), edge = polygon.col(i + 1 == n ? 0 : i + 1) - from;
    if (!(edge.squaredNorm() >= least * least)) return false;
    corners_[static_cast<std::size_t>(i)] = {same(from.x()), same(from.y()), same(edge.x()), same(edge.y())};
  }
  return true;
}

LaneMask MeanValueFarFromBoundary::evaluate(const LaneVector& x, Index row, ShapeTable& table) {
  const std::size_t n = corners_.size(), last = n - 1;
  const Corner* const corners = corners_.data();
  Vertex* const vertices = vertices_.data();
  Weight* const weights = weights_.data();

  Lanes nearest{}, steepest{};  // the largest 1 / rho and t^2
  for (std::size_t i = 0; i < n; ++i) {
    const LaneVector d{corners[i].x - x.x, corners[i].y - x.y};
    const Lanes rho = sqrt(dot(d, d)), inverse = 1 / rho;
    vertices[i] = {d, rho, inverse, (inverse * inverse) * d};
    nearest = larger(nearest, inverse);
  }

  // t = c / (rho rho' + d.d') or (rho rho' - d.d') / c, where nothing cancels; grad t = (1 + t^2) / 2 times
  // the difference of the gradients of both directions.
  const auto see_edge = [&](const Corner& corner, const Vertex& a, const Vertex& b) {
    const Lanes c = a.d.x * corner.edge_y - a.d.y * corner.edge_x, along = dot(a.d, b.d);
    const Lanes sum = a.rho * b.rho + abs(along);
    const auto obtuse = along < 0;
    const Lanes t = (obtuse ? sum : c) / (obtuse ? c : sum), square = t * t;
    steepest = larger(steepest, square);
    return Angle{t, (0.5 + 0.5 * square) * (b.per_square - a.per_square)};
  };
  Lanes sum{};
  LaneVector gradient_sum{};
  const auto set_weight = [&](std::size_t i, const Angle& before, const Angle& after) {
    const Vertex& vertex = vertices[i];
    const Lanes w = vertex.inverse * (before.t + after.t);
    const LaneVector change = vertex.inverse * (before.change + after.change);
    const LaneVector gradient{w * vertex.per_square.x + change.y, w * vertex.per_square.y - change.x};
    weights[i] = {w, gradient};
    sum += w;
    gradient_sum += gradient;
  };
  const Angle last_angle = see_edge(corners[last], vertices[last], vertices[0]);
  Angle before = last_angle;
  for (std::size_t i = 0; i < last; ++i) {
    const Angle angle = see_edge(corners[i], vertices[i], vertices[i + 1]);
    set_weight(i, before, angle);
    before = angle;
  }
  set_weight(last, before, last_angle);

  const Lanes inverse_sum = 1 / sum;
  double *values = &table.values(row, 0), *dx = &table.dx(row, 0), *dy = &table.dy(row, 0);
  const Index stride = table.n_points();
  for (std::size_t i = 0; i < n; ++i, values += stride, dx += stride, dy += stride) {
    const Lanes N = weights[i].w * inverse_sum;
    const LaneVector gradient = inverse_sum * (weights[i].gradient - N * gradient_sum);
    store(N, values);
    store(gradient.x, dx);
    store(gradient.y, dy);
  }
  return (nearest < largest_inverse_) & (steepest < largest_half_tangent * largest_half_tangent);
}

}  // namespace polyfem
