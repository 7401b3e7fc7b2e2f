#include <tests/oracle/deal_ii_element_matrices.hpp>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/tria.h>

#include <array>
#include <vector>

namespace oracle {
namespace {

/// deal.II numbers the vertices of a quadrilateral lexicographically; the exchange is its own inverse.
constexpr std::array<unsigned, 4> quadrilateral_order{0, 1, 3, 2};

unsigned polygon_vertex(unsigned deal_ii_vertex, bool triangle) {
  return triangle ? deal_ii_vertex : quadrilateral_order[deal_ii_vertex];
}

void make_single_cell(const polyfem::Points& vertices, dealii::Triangulation<2>& triangulation) {
  const unsigned n = static_cast<unsigned>(vertices.cols());
  std::vector<dealii::Point<2>> points;
  std::vector<dealii::CellData<2>> cells(1, dealii::CellData<2>(n));
  for (unsigned k = 0; k < n; ++k) {
    points.emplace_back(vertices(0, k), vertices(1, k));
    cells[0].vertices[k] = polygon_vertex(k, n == 3);
  }
  triangulation.create_triangulation(points, cells, dealii::SubCellData());
}

/// The element's integrals by the given rule: 2 mu eps : eps + lambda div div, and N . N.
ElementMatrices integrate(const dealii::Triangulation<2>& triangulation,
                          const dealii::FiniteElement<2>& element, const dealii::Quadrature<2>& quadrature,
                          double lambda, double mu) {
  const bool triangle = element.reference_cell() == dealii::ReferenceCells::Triangle;
  dealii::FEValues<2> values(element.reference_cell().get_default_linear_mapping<2>(), element, quadrature,
                             dealii::update_values | dealii::update_gradients | dealii::update_JxW_values);
  values.reinit(triangulation.begin_active());
  const dealii::FEValuesExtractors::Vector displacement(0);
  const unsigned n = element.n_dofs_per_cell();
  const auto place = [&](unsigned i) {
    const auto [component, vertex] = element.system_to_component_index(i);
    return static_cast<polyfem::Index>(2 * polygon_vertex(vertex, triangle) + component);
  };
  ElementMatrices result{polyfem::MatrixXd::Zero(n, n), polyfem::MatrixXd::Zero(n, n)};
  for (const unsigned q : values.quadrature_point_indices())
    for (unsigned i = 0; i < n; ++i)
      for (unsigned j = 0; j < n; ++j) {
        const auto& view = values[displacement];
        result.stiffness(place(i), place(j)) +=
            values.JxW(q) * (2 * mu * view.symmetric_gradient(i, q) * view.symmetric_gradient(j, q) +
                             lambda * view.divergence(i, q) * view.divergence(j, q));
        result.mass(place(i), place(j)) += values.JxW(q) * view.value(i, q) * view.value(j, q);
      }
  return result;
}

}  // namespace

ElementMatrices deal_ii_element_matrices(const polyfem::Points& vertices, double young, double poisson,
                                         unsigned n_gauss) {
  const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  const double mu = young / (2 * (1 + poisson));
  dealii::Triangulation<2> triangulation;
  make_single_cell(vertices, triangulation);
  if (vertices.cols() == 3)
    return integrate(triangulation, dealii::FESystem<2>(dealii::FE_SimplexP<2>(1), 2),
                     dealii::QGaussSimplex<2>(3), lambda, mu);
  return integrate(triangulation, dealii::FESystem<2>(dealii::FE_Q<2>(1), 2), dealii::QGauss<2>(n_gauss),
                   lambda, mu);
}

}  // namespace oracle
