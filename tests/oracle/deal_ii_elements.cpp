#include <tests/oracle/deal_ii_elements.hpp>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/tria.h>

#include <array>

namespace oracle {
namespace {

using polyfem::Index;
using polyfem::MatrixXd;

/// deal.II numbers the vertices of a quadrilateral lexicographically; the exchange is its own inverse.
constexpr std::array<unsigned, 4> quadrilateral_order{0, 1, 3, 2};

unsigned polygon_vertex(unsigned deal_ii_vertex, std::size_t n_vertices) {
  return n_vertices == 3 ? deal_ii_vertex : quadrilateral_order[deal_ii_vertex];
}

/// One cell a polygon, none touching another.
void make_cells(const std::vector<polyfem::Points>& polygons, dealii::Triangulation<2>& triangulation) {
  std::vector<dealii::Point<2>> points;
  std::vector<dealii::CellData<2>> cells;
  for (const polyfem::Points& polygon : polygons) {
    const unsigned n = static_cast<unsigned>(polygon.cols()), first = static_cast<unsigned>(points.size());
    cells.emplace_back(n);
    for (unsigned k = 0; k < n; ++k) {
      points.emplace_back(polygon(0, k), polygon(1, k));
      cells.back().vertices[k] = first + polygon_vertex(k, n);
    }
  }
  triangulation.create_triangulation(points, cells, dealii::SubCellData());
}

/// The displacement element's first component, alone as it stands.
polyfem::TabulatedElement tabulate(const dealii::FEValues<2>& values) {
  const Index q_count = values.n_quadrature_points, n = values.dofs_per_cell / 2;
  polyfem::TabulatedElement table;
  for (MatrixXd* m : {&table.values, &table.dx, &table.dy}) m->resize(q_count, n);
  table.rule.points.resize(2, q_count);
  table.rule.weights.resize(q_count);
  for (unsigned q = 0; q < q_count; ++q) {
    const dealii::Point<2>& x = values.quadrature_point(q);
    table.rule.points.col(q) << x[0], x[1];
    table.rule.weights[q] = values.JxW(q);
    for (unsigned i = 0; i < values.dofs_per_cell; ++i) {
      const auto [component, corner] = values.get_fe().system_to_component_index(i);
      if (component != 0) continue;
      const unsigned k = polygon_vertex(corner, n);
      table.values(q, k) = values.shape_value(i, q);
      table.dx(q, k) = values.shape_grad(i, q)[0];
      table.dy(q, k) = values.shape_grad(i, q)[1];
    }
  }
  table.area = table.rule.weights.sum();
  return table;
}

/// The element's integrals by deal.II's own forms: 2 mu eps : eps + lambda div div, and N . N.
Element integrate(const dealii::FEValues<2>& values, double lambda, double mu) {
  const unsigned n = values.dofs_per_cell;
  const auto place = [&](unsigned i) {
    const auto [component, corner] = values.get_fe().system_to_component_index(i);
    return static_cast<Index>(2 * polygon_vertex(corner, n / 2) + component);
  };
  const auto& u = values[dealii::FEValuesExtractors::Vector(0)];
  Element result{tabulate(values), MatrixXd::Zero(n, n), MatrixXd::Zero(n, n)};
  for (const unsigned q : values.quadrature_point_indices())
    for (unsigned i = 0; i < n; ++i)
      for (unsigned j = 0; j < n; ++j) {
        result.stiffness(place(i), place(j)) +=
            values.JxW(q) * (2 * mu * u.symmetric_gradient(i, q) * u.symmetric_gradient(j, q) +
                             lambda * u.divergence(i, q) * u.divergence(j, q));
        result.mass(place(i), place(j)) += values.JxW(q) * u.value(i, q) * u.value(j, q);
      }
  return result;
}

}  // namespace

std::vector<Element> deal_ii_elements(const std::vector<polyfem::Points>& polygons, double young,
                                      double poisson, unsigned n_gauss) {
  const bool triangles = polygons.front().cols() == 3;
  const auto element = triangles ? dealii::FESystem<2>(dealii::FE_SimplexP<2>(1), 2)
                                 : dealii::FESystem<2>(dealii::FE_Q<2>(1), 2);
  const dealii::Quadrature<2> rule =
      triangles ? dealii::Quadrature<2>(dealii::QGaussSimplex<2>(3)) : dealii::QGauss<2>(n_gauss);
  dealii::Triangulation<2> triangulation;
  make_cells(polygons, triangulation);
  dealii::FEValues<2> values(element.reference_cell().get_default_linear_mapping<2>(), element, rule,
                             dealii::update_values | dealii::update_gradients |
                                 dealii::update_quadrature_points | dealii::update_JxW_values);
  const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  const double mu = young / (2 * (1 + poisson));
  std::vector<Element> result;
  for (const auto& cell : triangulation.active_cell_iterators()) {
    values.reinit(cell);
    result.push_back(integrate(values, lambda, mu));
  }
  return result;
}

std::vector<MatrixXd> deal_ii_serendipity_stiffness(const std::vector<polyfem::Points>& polygons,
                                                    double young, double poisson) {
  // The nodes of Q2, four vertices in lexicographic order, the sides x = 0, 1 and y = 0, 1, and the middle,
  // in the order of the polygon.
  constexpr std::array<Index, 8> node{0, 2, 6, 4, 7, 3, 1, 5};
  MatrixXd T = MatrixXd::Zero(18, 16);
  const dealii::FESystem<2> element(dealii::FE_Q<2>(2), 2);
  for (unsigned i = 0; i < 18; ++i) {
    const auto [component, k] = element.system_to_component_index(i);
    if (k < 8)
      T(i, 2 * node[k] + component) = 1;
    else
      for (Index other = 0; other < 8; ++other) T(i, 2 * other + component) = other % 2 == 0 ? -0.25 : 0.5;
  }
  dealii::Triangulation<2> triangulation;
  make_cells(polygons, triangulation);
  dealii::FEValues<2> values(element, dealii::QGauss<2>(3),
                             dealii::update_gradients | dealii::update_JxW_values);
  const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  const double mu = young / (2 * (1 + poisson));
  std::vector<MatrixXd> result;
  for (const auto& cell : triangulation.active_cell_iterators()) {
    values.reinit(cell);
    const auto& u = values[dealii::FEValuesExtractors::Vector(0)];
    MatrixXd K = MatrixXd::Zero(18, 18);
    for (const unsigned q : values.quadrature_point_indices())
      for (unsigned i = 0; i < 18; ++i)
        for (unsigned j = 0; j < 18; ++j)
          K(i, j) += values.JxW(q) * (2 * mu * u.symmetric_gradient(i, q) * u.symmetric_gradient(j, q) +
                                      lambda * u.divergence(i, q) * u.divergence(j, q));
    result.push_back(T.transpose() * K * T);
  }
  return result;
}

}  // namespace oracle
