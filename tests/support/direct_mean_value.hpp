/// \file Mean value functions by their formula, for points inside a simple polygon and not at its boundary:
/// a basis the library does not know.
#pragma once

#include <polyfem/basis/basis.hpp>

#include <vector>

namespace support {

class DirectMeanValue final : public polyfem::Basis {
 public:
  std::string_view name() const override { return "direct mean value"; }
  std::optional<polyfem::Rejection> find_rejection(const polyfem::PointsRef&) const override {
    return std::nullopt;
  }

  /// With r_i = v_i - x and t_i = cross(r_i, r_i+1) / (|r_i| |r_i+1| + r_i . r_i+1), the tangent of half the
  /// angle at x, the weights are w_i = (t_i-1 + t_i) / |r_i|.
  void evaluate(const polyfem::PointsRef& polygon, const polyfem::PointsRef& points,
                polyfem::ShapeTable& table) const override {
    using polyfem::Index, polyfem::Vec2;
    const Index n = polygon.cols();
    const auto at = [](Index i) { return static_cast<std::size_t>(i); };
    table.values.resize(points.cols(), n);
    table.dx.resize(points.cols(), n);
    table.dy.resize(points.cols(), n);
    std::vector<Vec2> r(at(n)), slope(at(n));  // slopes are gradients by x
    std::vector<double> length(at(n)), tangent(at(n));
    for (Index q = 0; q < points.cols(); ++q) {
      for (Index i = 0; i < n; ++i) {
        r[at(i)] = polygon.col(i) - points.col(q);
        length[at(i)] = r[at(i)].norm();
      }
      for (Index i = 0; i < n; ++i) {
        const std::size_t a = at(i), b = at((i + 1) % n);
        const double below = length[a] * length[b] + r[a].dot(r[b]);
        tangent[a] = polyfem::cross(r[a], r[b]) / below;
        const Vec2 edge = r[b] - r[a], turned(-edge.y(), edge.x());
        slope[a] = (turned +
                    tangent[a] * (r[a] * (1 + length[b] / length[a]) + r[b] * (1 + length[a] / length[b]))) /
                   below;
      }
      double sum = 0;
      Vec2 sum_slope = Vec2::Zero();
      for (Index i = 0; i < n; ++i) {
        const std::size_t before = at((i + n - 1) % n), k = at(i);
        const double w = (tangent[before] + tangent[k]) / length[k];
        const Vec2 dw = (slope[before] + slope[k]) / length[k] + w * r[k] / (length[k] * length[k]);
        table.values(q, i) = w;
        table.dx(q, i) = dw.x();
        table.dy(q, i) = dw.y();
        sum += w;
        sum_slope += dw;
      }
      table.values.row(q) /= sum;
      table.dx.row(q) = (table.dx.row(q) - table.values.row(q) * sum_slope.x()) / sum;
      table.dy.row(q) = (table.dy.row(q) - table.values.row(q) * sum_slope.y()) / sum;
    }
  }
};

}  // namespace support
