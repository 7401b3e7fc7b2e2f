/// \file Eq. (6) as it is written, O(n^2), in extended precision: the oracle of the fast path.
#pragma once

#include <polyfem/basis/basis.hpp>

#include <vector>

inline void direct_wachspress(const polyfem::PointsRef& polygon, const polyfem::Vec2& x,
                              polyfem::ShapeValues& shape) {
  using Real = long double;  // its exponents reach 1e4932: no scaling needed
  const int n = static_cast<int>(polygon.cols());
  struct Pair {
    Real x, y;
  };
  std::vector<Pair> d(n), edge(n);
  std::vector<Real> a(n);
  for (int k = 0; k < n; ++k) {
    d[k] = {Real(polygon(0, k)) - x.x(), Real(polygon(1, k)) - x.y()};
    const int next = (k + 1) % n;
    edge[k] = {Real(polygon(0, next)) - polygon(0, k), Real(polygon(1, next)) - polygon(1, k)};
  }
  for (int k = 0; k < n; ++k) a[k] = d[k].x * d[(k + 1) % n].y - d[k].y * d[(k + 1) % n].x;

  std::vector<Real> w(n), wx(n), wy(n);
  Real sum = 0, sum_x = 0, sum_y = 0;
  for (int i = 0; i < n; ++i) {
    const int before = (i + n - 1) % n;
    const Real b = edge[before].x * edge[i].y - edge[before].y * edge[i].x;
    Real product = b, product_x = 0, product_y = 0;
    for (int k = 0; k < n; ++k) {
      if (k == i || k == before) continue;
      product_x = product_x * a[k] - product * edge[k].y;  // the gradient of a_k is the edge turned left
      product_y = product_y * a[k] + product * edge[k].x;
      product *= a[k];
    }
    w[i] = product, wx[i] = product_x, wy[i] = product_y;
    sum += product, sum_x += product_x, sum_y += product_y;
  }
  shape.values.resize(n);
  shape.gradients.resize(2, n);
  for (int i = 0; i < n; ++i) {
    shape.values[i] = static_cast<double>(w[i] / sum);
    shape.gradients(0, i) = static_cast<double>((wx[i] - w[i] / sum * sum_x) / sum);
    shape.gradients(1, i) = static_cast<double>((wy[i] - w[i] / sum * sum_y) / sum);
  }
}
