#include <polyfem/quadrature/gauss_rule.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace polyfem {
namespace {

constexpr int most_points = 64;

}  // namespace

/// Roots of the Legendre polynomial P_n by Newton's method from the usual cosine, in extended precision.
GaussRule gauss_legendre(int n) {
  GaussRule rule{VectorXd(n), VectorXd(n)};
  for (int i = 0; i < n; ++i) {
    long double x = -std::cos(std::numbers::pi_v<long double> * (i + 0.75L) / (n + 0.5L)), slope = 1;
    for (int iteration = 0; iteration < 8; ++iteration) {
      long double value = 1, previous = 0;
      for (int k = 1; k <= n; ++k) {
        const long double next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
        previous = value;
        value = next;
      }
      slope = n * (x * value - previous) / (x * x - 1);
      x -= value / slope;
    }
    rule.points[i] = static_cast<double>((1 + x) / 2);
    rule.weights[i] = static_cast<double>(1 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

const GaussRule& gauss_rule(int n) {
  static const auto rules = [] {
    std::array<GaussRule, most_points + 1> all;
    for (int k = 1; k <= most_points; ++k) all[static_cast<std::size_t>(k)] = gauss_legendre(k);
    return all;
  }();
  assert(n >= 1 && n <= most_points);
  return rules[static_cast<std::size_t>(n)];
}

void make_graded_gauss_rule(int n, const GradedMap& map, GaussRule& rule) {
  rule = gauss_rule(n);
  for (Index q = 0; q < n; ++q) {
    const GradedMap::Image image = map(rule.points[q]);
    rule.points[q] = image.t;
    rule.weights[q] *= image.slope;
  }
}

int n_gauss_points(double digits, double axis) {
  const double n = std::ceil(digits / (2 * std::acosh(axis)) + 1);
  return n <= most_points ? std::max(1, static_cast<int>(n)) : most_points;  // also where n is not a number
}

}  // namespace polyfem
