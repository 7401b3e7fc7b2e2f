#include <ddacontact/block/integration.hpp>

#include <polyfem/element/definiteness.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/quadrature/gauss_rule.hpp>
#include <polyfem/quadrature/triangle_rule.hpp>

#include <array>

namespace ddacontact {

using polyfem::GradientCorrection;
using polyfem::TriangleRule;

Integration choose_integration(const PointsRef& outline, GradientCorrection correction,
                               const polyfem::Basis& basis) {
  constexpr int many = 12;
  static const TriangleRule fine = polyfem::collapsed_gauss_rule(many, many, 2);
  const std::array rules{&polyfem::hammer_rule(3), &polyfem::hammer_rule(5), &fine};
  const Mat3 elasticity = polyfem::elasticity_matrix(1, 0.3, polyfem::Plane::strain);
  polyfem::TabulatedElement element;
  MatrixXd K, M;
  for (const TriangleRule* rule : rules) {
    tabulate(outline, *rule, basis, correction, element);
    polyfem::stiffness(element, elasticity, K);
    polyfem::mass(element, M);
    const bool definite = polyfem::judge(K, M).definite();
    if (definite || correction == GradientCorrection::off) return {rule, correction, definite};
  }
  return {rules.back(), correction, false};
}

}  // namespace ddacontact
