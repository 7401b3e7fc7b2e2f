#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <tests/oracle/difference.hpp>

#include <algorithm>

namespace oracle {
namespace {

using polyfem::MatrixXd;

double relative_difference(const MatrixXd& a, const MatrixXd& b) {
  return (a - b).norm() / b.norm();
}

double gradient_difference(const polyfem::ShapeTable& a, const polyfem::ShapeTable& b) {
  const auto size = [](const MatrixXd& dx, const MatrixXd& dy) {  // largest at each point
    return (dx.array().square() + dy.array().square()).rowwise().maxCoeff().sqrt().eval();
  };
  return (size(a.dx - b.dx, a.dy - b.dy) / size(b.dx, b.dy)).maxCoeff();
}

}  // namespace

Difference Difference::larger(const Difference& a, const Difference& b) {
  return {std::max(a.values, b.values), std::max(a.gradients, b.gradients),
          std::max(a.stiffness, b.stiffness), std::max(a.mass, b.mass)};
}

Difference difference_to_ours(const polyfem::Points& polygon, const Element& theirs) {
  polyfem::TabulatedElement ours;
  MatrixXd K, M;
  tabulate(polygon, theirs.table.rule, polyfem::wachspress, polyfem::GradientCorrection::off, ours);
  stiffness(ours, polyfem::elasticity_matrix(young, poisson, polyfem::Plane::strain), K);
  mass(ours, M);
  return {(ours.values - theirs.table.values).cwiseAbs().maxCoeff(), gradient_difference(ours, theirs.table),
          relative_difference(K, theirs.stiffness), relative_difference(M, theirs.mass)};
}

std::vector<Difference> differences(const std::vector<polyfem::Points>& polygons, unsigned n_gauss) {
  const std::vector<Element> elements = deal_ii_elements(polygons, young, poisson, n_gauss);
  std::vector<Difference> result;
  for (std::size_t k = 0; k < polygons.size(); ++k)
    result.push_back(difference_to_ours(polygons[k], elements[k]));
  return result;
}

}  // namespace oracle
