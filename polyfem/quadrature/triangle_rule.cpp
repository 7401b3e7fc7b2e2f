#include <polyfem/core/error.hpp>
#include <polyfem/quadrature/gauss_rule.hpp>
#include <polyfem/quadrature/triangle_rule.hpp>

#include <array>
#include <cmath>
#include <string>

namespace polyfem {
namespace {

/// Appends the points of an orbit under the symmetries of the triangle.
class SymmetricRule {
 public:
  explicit SymmetricRule(int degree) { rule_.degree = degree; }

  SymmetricRule& centroid(double weight) {
    rule_.add(1. / 3, 1. / 3, weight);
    return *this;
  }
  /// (1 - 2a, a, a) and its rotations.
  SymmetricRule& three(double a, double weight) {
    rule_.add(1 - 2 * a, a, weight);
    rule_.add(a, 1 - 2 * a, weight);
    rule_.add(a, a, weight);
    return *this;
  }
  const TriangleRule& rule() const { return rule_; }

 private:
  TriangleRule rule_;
};

/// P. C. Hammer, A. H. Stroud, "Numerical integration over simplexes and cones", 1956 (degrees 1, 2, 3, 5);
/// the six points of degree 4 in the closed form of the rule printed with 15 digits by G. R. Cowper, 1973.
std::array<TriangleRule, 5> hammer_rules() {
  const double s10 = std::sqrt(10.), s15 = std::sqrt(15.);
  const double point4 = std::sqrt(38 - 44 * std::sqrt(0.4)), weight4 = std::sqrt(213125 - 53320 * s10);
  return {SymmetricRule(1).centroid(1).rule(),  //
          SymmetricRule(2).three(1. / 6, 1. / 3).rule(),
          SymmetricRule(3).centroid(-9. / 16).three(1. / 5, 25. / 48).rule(),
          SymmetricRule(4)
              .three((8 - s10 + point4) / 18, (620 + weight4) / 3720)
              .three((8 - s10 - point4) / 18, (620 - weight4) / 3720)
              .rule(),
          SymmetricRule(5)
              .centroid(9. / 40)
              .three((6 + s15) / 21, (155 + s15) / 1200)
              .three((6 - s15) / 21, (155 - s15) / 1200)
              .rule()};
}

}  // namespace

void TriangleRule::add(double l1, double l2, double weight) {
  const Index q = weights.size();
  points.conservativeResize(3, q + 1);
  weights.conservativeResize(q + 1);
  points.col(q) << l1, l2, 1 - l1 - l2;
  weights[q] = weight;
}

const TriangleRule& hammer_rule(int degree) {
  static const std::array<TriangleRule, 5> rules = hammer_rules();
  if (degree < 1 || degree > 5)
    throw Error("hammer_rule: no rule of degree " + std::to_string(degree) + ", choose 1 to 5");
  return rules[static_cast<std::size_t>(degree - 1)];
}

TriangleRule collapsed_gauss_rule(int across, int along, int grading) {
  if (grading < 1 || across < grading || along < 1)
    throw Error("collapsed_gauss_rule: needs along >= 1 and across >= grading >= 1, not across = " +
                std::to_string(across) + ", along = " + std::to_string(along) +
                ", grading = " + std::to_string(grading));
  const GaussRule z = gauss_legendre(across), t = gauss_legendre(along);
  TriangleRule rule;
  rule.points.resize(3, across * along);
  rule.weights.resize(across * along);
  rule.degree = std::min(2 * across / grading, 2 * along) - 2;
  for (int i = 0, q = 0; i < across; ++i) {
    const double l1 = std::pow(1 - z.points[i], grading), s = 1 - l1;
    const double ds = grading * std::pow(1 - z.points[i], grading - 1) * z.weights[i];
    for (int j = 0; j < along; ++j, ++q) {
      rule.points.col(q) << l1, s * (1 - t.points[j]), s * t.points[j];
      rule.weights[q] = 2 * s * ds * t.weights[j];
    }
  }
  return rule;
}

}  // namespace polyfem
