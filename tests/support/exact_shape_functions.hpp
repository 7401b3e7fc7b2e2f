/// \file Shape functions to 50 digits, of the polygon and the point as they are in double.
#pragma once

#include <polyfem/basis/basis.hpp>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <vector>

namespace support {

using Real =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

/// A function's value and gradient at a point.
struct ExactShape {
  Real value = 1, dx = 0, dy = 0;
};

inline ExactShape operator*(const ExactShape& f, const ExactShape& g) {
  return {f.value * g.value, f.value * g.dx + f.dx * g.value, f.value * g.dy + f.dy * g.value};
}

/// Eq. (6) with running products from both sides; its exponents reach far enough for any of them.
inline std::vector<ExactShape> exact_wachspress(const polyfem::PointsRef& polygon, const polyfem::Vec2& x) {
  const std::size_t n = static_cast<std::size_t>(polygon.cols());
  std::vector<ExactShape> area(n), weight(n);
  for (std::size_t k = 0; k < n; ++k) {
    const polyfem::Vec2 from = polygon.col(static_cast<polyfem::Index>(k)),
                        to = polygon.col(static_cast<polyfem::Index>((k + 1) % n));
    const Real edge_x = Real(to.x()) - from.x(), edge_y = Real(to.y()) - from.y();
    area[k] = {(Real(from.x()) - x.x()) * edge_y - (Real(from.y()) - x.y()) * edge_x, -edge_y, edge_x};
  }
  // prod_{k != i-1, i} a_k = (a_0 .. a_i-2)(a_i+1 .. a_n-1), and a_1 .. a_n-2 for i = 0
  for (std::size_t k = 1; k + 1 < n; ++k) weight[0] = weight[0] * area[k];
  for (std::size_t i = 2; i < n; ++i) weight[i] = weight[i - 1] * area[i - 2];
  ExactShape behind;
  for (std::size_t i = n - 1; i > 0; --i) {
    weight[i] = weight[i] * behind;
    behind = behind * area[i];
  }
  ExactShape sum{0, 0, 0};
  for (std::size_t i = 0; i < n; ++i) {
    const ExactShape &in = area[(i + n - 1) % n], &out = area[i];
    const Real b = in.dx * out.dy - in.dy * out.dx;  // of edges turned left: the same
    weight[i] = weight[i] * ExactShape{b, 0, 0};
    sum = {sum.value + weight[i].value, sum.dx + weight[i].dx, sum.dy + weight[i].dy};
  }
  for (ExactShape& N : weight) {
    N.value /= sum.value;
    N.dx = (N.dx - N.value * sum.dx) / sum.value;
    N.dy = (N.dy - N.value * sum.dy) / sum.value;
  }
  return weight;
}

/// Largest errors of the functions at a point: of values, and of gradients over the largest gradient.
struct ShapeErrors {
  double value = 0, gradient = 0;
};

/// What does not compare as a number counts as infinite.
inline ShapeErrors shape_errors(const polyfem::ShapeTable& table, polyfem::Index q,
                                const std::vector<ExactShape>& exact) {
  Real value = 0, gradient = 0, largest = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const polyfem::Index vertex = static_cast<polyfem::Index>(i);
    const Real dx = table.dx(q, vertex) - exact[i].dx, dy = table.dy(q, vertex) - exact[i].dy;
    value = std::max<Real>(value, abs(table.values(q, vertex) - exact[i].value));
    gradient = std::max<Real>(gradient, sqrt(dx * dx + dy * dy));
    largest = std::max<Real>(largest, sqrt(exact[i].dx * exact[i].dx + exact[i].dy * exact[i].dy));
  }
  const bool finite =
      table.values.row(q).allFinite() && table.dx.row(q).allFinite() && table.dy.row(q).allFinite();
  if (!finite) return {HUGE_VAL, HUGE_VAL};
  return {static_cast<double>(value), static_cast<double>(Real(gradient / largest))};
}

}  // namespace support
