/// \file Mean value functions by their textbook formula with 100 digits: the oracle of the fast form.
#pragma once

#include <polyfem/basis/basis.hpp>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <vector>

/// At a point that is no vertex. On an edge: at a point inside, 1e-40 of the edge's length away.
inline void exact_mean_value(const polyfem::PointsRef& polygon, const polyfem::Vec2& x,
                             polyfem::ShapeValues& shape) {
  using Real = boost::multiprecision::cpp_bin_float_100;
  struct Vector {
    Real x, y;
  };
  const std::size_t n = static_cast<std::size_t>(polygon.cols());
  const auto after = [n](std::size_t i) { return i + 1 == n ? 0 : i + 1; };
  std::vector<Vector> d(n);
  for (std::size_t i = 0; i < n; ++i) {
    const polyfem::Vec2 v = polygon.col(static_cast<polyfem::Index>(i));
    d[i] = {Real(v.x()) - x.x(), Real(v.y()) - x.y()};
  }
  const auto dot = [&](std::size_t i, std::size_t j) -> Real { return d[i].x * d[j].x + d[i].y * d[j].y; };
  const auto cross = [&](std::size_t i, std::size_t j) -> Real { return d[i].x * d[j].y - d[i].y * d[j].x; };
  for (std::size_t i = 0; i < n; ++i)
    if (cross(i, after(i)) == 0 && dot(i, after(i)) < 0) {
      const Real step("1e-40");
      const Vector edge{d[after(i)].x - d[i].x, d[after(i)].y - d[i].y};
      for (Vector& v : d) v = {v.x + step * edge.y, v.y - step * edge.x};
      break;
    }

  std::vector<Real> t(n), rho(n), w(n);
  std::vector<Vector> t_gradient(n), w_gradient(n);
  for (std::size_t i = 0; i < n; ++i) rho[i] = sqrt(dot(i, i));
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = after(i);
    const Real product = rho[i] * rho[k], s = rho[i] * rho[i], r = rho[k] * rho[k];
    t[i] = dot(i, k) < 0 ? Real((product - dot(i, k)) / cross(i, k)) : Real(cross(i, k) / (product + dot(i, k)));
    const Real half = (1 + t[i] * t[i]) / 2;  // times the gradient of the angle
    t_gradient[i] = {half * (d[k].y / r - d[i].y / s), half * (d[i].x / s - d[k].x / r)};
  }
  Real sum = 0, sum_x = 0, sum_y = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = i == 0 ? n - 1 : i - 1;
    w[i] = (t[k] + t[i]) / rho[i];
    const Real of_rho = w[i] / (rho[i] * rho[i]);
    w_gradient[i] = {(t_gradient[k].x + t_gradient[i].x) / rho[i] + of_rho * d[i].x,
                     (t_gradient[k].y + t_gradient[i].y) / rho[i] + of_rho * d[i].y};
    sum += w[i];
    sum_x += w_gradient[i].x;
    sum_y += w_gradient[i].y;
  }
  shape.values.resize(polygon.cols());
  shape.gradients.resize(2, polygon.cols());
  for (std::size_t i = 0; i < n; ++i) {
    const polyfem::Index vertex = static_cast<polyfem::Index>(i);
    const Real N = w[i] / sum;
    shape.values[vertex] = static_cast<double>(N);
    shape.gradients(0, vertex) = static_cast<double>(Real((w_gradient[i].x - N * sum_x) / sum));
    shape.gradients(1, vertex) = static_cast<double>(Real((w_gradient[i].y - N * sum_y) / sum));
  }
}
