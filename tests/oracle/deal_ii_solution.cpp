#include <polyfem/dealii/vertex_dofs.hpp>
#include <tests/oracle/deal_ii_solution.hpp>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/vector_tools_boundary.h>

namespace oracle {
namespace {

using Point = dealii::Point<2>;
using Tensor = dealii::Tensor<1, 2>;

polyfem::Vec2 ours(const Point& x) {
  return {x[0], x[1]};
}

Tensor theirs(const polyfem::Vec2& x) {
  return Point(x.x(), x.y());
}

class Displacement : public dealii::Function<2> {
 public:
  explicit Displacement(const PlaneStrain& problem) : Function(2), problem_(problem) {}
  double value(const Point& x, unsigned component) const override {
    return problem_.displacement(ours(x))[component];
  }

 private:
  const PlaneStrain& problem_;
};

/// One linear system, from the element to the solution.
class Solution {
 public:
  Solution(const dealii::Triangulation<2>& triangulation, const PlaneStrain& problem)
      : problem_(problem),
        triangles_(triangulation.all_reference_cells_are_simplex()),
        element_(triangles_ ? dealii::FESystem<2>(dealii::FE_SimplexP<2>(1), 2)
                            : dealii::FESystem<2>(dealii::FE_Q<2>(1), 2)),
        mapping_(element_.reference_cell().get_default_linear_mapping<2>()),
        dof_handler_(triangulation) {
    dof_handler_.distribute_dofs(element_);
    hold_boundary();
    dealii::DynamicSparsityPattern pattern(dof_handler_.n_dofs());
    dealii::DoFTools::make_sparsity_pattern(dof_handler_, pattern, held_, false);
    pattern_.copy_from(pattern);
    K_.reinit(pattern_);
    d_.reinit(dof_handler_.n_dofs());
    assemble();
    dealii::SparseDirectUMFPACK umfpack;
    umfpack.solve(K_, d_);
    held_.distribute(d_);
  }

  const dealii::DoFHandler<2>& dof_handler() const { return dof_handler_; }
  const dealii::Vector<double>& displacements() const { return d_; }

 private:
  void hold_boundary() {
    const Displacement displacement(problem_);
    for (const auto id : dof_handler_.get_triangulation().get_boundary_ids())
      if (id != loaded_boundary)
        dealii::VectorTools::interpolate_boundary_values(mapping_, dof_handler_, id, displacement, held_);
    held_.close();
  }

  void assemble() {
    const dealii::Quadrature<2> rule =
        triangles_ ? dealii::Quadrature<2>(dealii::QGaussSimplex<2>(3)) : dealii::QGauss<2>(8);
    dealii::FEValues<2> values(mapping_, element_, rule,
                               dealii::update_values | dealii::update_gradients |
                                   dealii::update_quadrature_points | dealii::update_JxW_values);
    dealii::FEFaceValues<2> face_values(mapping_, element_, dealii::QGauss<1>(3),
                                        dealii::update_values | dealii::update_normal_vectors |
                                            dealii::update_quadrature_points | dealii::update_JxW_values);
    const unsigned n = element_.n_dofs_per_cell();
    dealii::FullMatrix<double> K(n, n);
    dealii::Vector<double> f(n);
    std::vector<dealii::types::global_dof_index> dofs(n);
    for (const auto& cell : dof_handler_.active_cell_iterators()) {
      K = 0;
      f = 0;
      values.reinit(cell);
      add_cell(values, K, f);
      for (const unsigned face : cell->face_indices())
        if (cell->face(face)->at_boundary() && cell->face(face)->boundary_id() == loaded_boundary) {
          face_values.reinit(cell, face);
          add_tractions(face_values, f);
        }
      cell->get_dof_indices(dofs);
      held_.distribute_local_to_global(K, f, dofs, K_, d_);
    }
  }

  void add_cell(const dealii::FEValues<2>& values, dealii::FullMatrix<double>& K,
                dealii::Vector<double>& f) const {
    const auto& u = values[dealii::FEValuesExtractors::Vector(0)];
    for (const unsigned q : values.quadrature_point_indices()) {
      const Tensor body_force = theirs(problem_.body_force(ours(values.quadrature_point(q))));
      for (const unsigned i : values.dof_indices()) {
        for (const unsigned j : values.dof_indices())
          K(i, j) +=
              values.JxW(q) * (2 * problem_.mu * u.symmetric_gradient(i, q) * u.symmetric_gradient(j, q) +
                               problem_.lambda * u.divergence(i, q) * u.divergence(j, q));
        f(i) += values.JxW(q) * u.value(i, q) * body_force;
      }
    }
  }

  void add_tractions(const dealii::FEFaceValues<2>& values, dealii::Vector<double>& f) const {
    const auto& u = values[dealii::FEValuesExtractors::Vector(0)];
    for (const unsigned q : values.quadrature_point_indices()) {
      const Point normal(values.normal_vector(q));
      const Tensor traction = theirs(problem_.stress(ours(values.quadrature_point(q))) * ours(normal));
      for (const unsigned i : values.dof_indices()) f(i) += values.JxW(q) * u.value(i, q) * traction;
    }
  }

  const PlaneStrain& problem_;
  bool triangles_;
  dealii::FESystem<2> element_;
  const dealii::Mapping<2>& mapping_;
  dealii::DoFHandler<2> dof_handler_;
  dealii::AffineConstraints<double> held_;
  dealii::SparsityPattern pattern_;
  dealii::SparseMatrix<double> K_;
  dealii::Vector<double> d_;
};

}  // namespace

polyfem::VectorXd deal_ii_solution(const dealii::Triangulation<2>& triangulation,
                                   const polyfem::TriangulationMesh& mesh, const PlaneStrain& problem) {
  const Solution solution(triangulation, problem);
  return from_dofs(mesh, solution.dof_handler(), solution.displacements());
}

}  // namespace oracle
