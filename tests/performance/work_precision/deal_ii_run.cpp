#include <tests/performance/work_precision/deal_ii_run.hpp>

#include <deal.II/base/function.h>
#include <deal.II/base/multithread_info.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/vector_tools_boundary.h>
#include <polyfem/assembly/cholesky.hpp>
#include <polyfem/core/error.hpp>

#include <Eigen/LU>

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

using polyfem::Mat3;
using polyfem::Vec2;
using polyfem::Vec3;

namespace work_precision {
namespace {

template <class Point>
Vec2 vector_of(const Point& point) {
  return {point[0], point[1]};
}

void make_triangulation(const Problem& problem, const polyfem::PolygonMesh& mesh,
                        dealii::Triangulation<2>& triangulation) {
  std::vector<dealii::Point<2>> points;
  for (const auto& vertex : mesh.vertices.colwise()) points.emplace_back(vertex.x(), vertex.y());
  std::vector<dealii::CellData<2>> cells;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const auto corners = mesh.cell(c);
    dealii::CellData<2>& cell = cells.emplace_back(static_cast<unsigned>(corners.size()));
    for (std::size_t k = 0; k < corners.size(); ++k) cell.vertices[k] = static_cast<unsigned>(corners[k]);
    if (corners.size() == 4) std::swap(cell.vertices[2], cell.vertices[3]);  // lexicographic
  }
  triangulation.create_triangulation(points, cells, dealii::SubCellData());
  for (const auto& cell : triangulation.active_cell_iterators())
    for (const unsigned f : cell->face_indices())
      if (cell->face(f)->at_boundary())
        cell->face(f)->set_boundary_id(static_cast<dealii::types::boundary_id>(
            problem.boundary(vector_of(cell->face(f)->center())).number()));
}

struct HeldValues final : dealii::Function<2> {
  explicit HeldValues(const Problem& p) : dealii::Function<2>(2), problem(p) {}
  void vector_value(const dealii::Point<2>& x, dealii::Vector<double>& value) const override {
    const Vec2 u = problem.exact() ? problem.solution.displacement(vector_of(x)) : Vec2::Zero();
    for (const unsigned c : {0u, 1u}) value[c] = u[c];
  }
  const Problem& problem;
};

/// A polynomial space for one displacement component, with its rules.
struct Choice {
  std::unique_ptr<dealii::FiniteElement<2>> element;
  dealii::Quadrature<2> rule, error_rule;
  std::optional<dealii::Quadrature<2>> volumetric_rule;
};

Choice choose(DealIIElement element) {
  switch (element) {
    case DealIIElement::q1:
      return {std::make_unique<dealii::FE_Q<2>>(1), dealii::QGauss<2>(2), dealii::QGauss<2>(4), {}};
    case DealIIElement::q1_reduced:
      return {std::make_unique<dealii::FE_Q<2>>(1), dealii::QGauss<2>(2), dealii::QGauss<2>(4),
              dealii::QGauss<2>(1)};
    case DealIIElement::q2:
      return {std::make_unique<dealii::FE_Q<2>>(2), dealii::QGauss<2>(3), dealii::QGauss<2>(5), {}};
    case DealIIElement::p1:
      break;
  }
  return {std::make_unique<dealii::FE_SimplexP<2>>(1),
          dealii::QGaussSimplex<2>(1),
          dealii::QGaussSimplex<2>(4),
          {}};
}

class Discretization {
 public:
  Discretization(const Problem& problem, const polyfem::PolygonMesh& mesh, DealIIElement kind)
      : problem_(problem),
        choice_(choose(kind)),
        system_(*choice_.element, 2),
        mapping_(choice_.element->reference_cell().get_default_linear_mapping<2>()) {
    StopWatch watch;
    make_triangulation(problem, mesh, triangulation_);
    stages_.mesh = watch.lap();
    set_up();
    stages_.pattern = watch.lap();
    assemble();
    stages_.assembly = watch.lap();
  }

  Run solve(bool with_cg, bool with_errors) {
    Run run;
    run.stages["umfpack"] = solve_by_umfpack();
    run.accuracy = accuracy(with_errors);
    run.stages["cholmod"] = solve_by_cholesky();
    if (with_cg) run.stages["cg"] = solve_by_cg();
    return run;
  }

 private:
  void set_up() {
    dof_handler_.reinit(triangulation_);
    dof_handler_.distribute_dofs(system_);
    const HeldValues values(problem_);
    for (const auto id : triangulation_.get_boundary_ids())
      if (id % 4 != 0)
        dealii::VectorTools::interpolate_boundary_values(
            mapping_, dof_handler_, id, values, constraints_,
            dealii::ComponentMask(std::vector<bool>{(id & 1) != 0, (id & 2) != 0}));
    constraints_.close();
    dealii::DynamicSparsityPattern pattern(dof_handler_.n_dofs());
    dealii::DoFTools::make_sparsity_pattern(dof_handler_, pattern, constraints_, false);
    pattern_.copy_from(pattern);
    matrix_.reinit(pattern_);
    load_.reinit(dof_handler_.n_dofs());
    solution_.reinit(dof_handler_.n_dofs());
  }

  /// Adds the integral of B^T D B: sums of gradient products first, D once.
  void add_stiffness(const dealii::FEValues<2>& values, const Mat3& D, dealii::FullMatrix<double>& K) const {
    const unsigned n = values.dofs_per_cell, n_points = values.n_quadrature_points;
    for (unsigned a = 0; a < n; ++a)
      for (unsigned b = 0; b <= a; ++b) {
        double xx = 0, xy = 0, yx = 0, yy = 0;
        for (unsigned q = 0; q < n_points; ++q) {
          const dealii::Tensor<1, 2>&g = values.shape_grad(a, q), &h = values.shape_grad(b, q);
          const double gx = g[0] * values.JxW(q), gy = g[1] * values.JxW(q);
          xx += gx * h[0];
          xy += gx * h[1];
          yx += gy * h[0];
          yy += gy * h[1];
        }
        const std::array<double, 4> block{D(0, 0) * xx + D(2, 2) * yy, D(0, 1) * xy + D(2, 2) * yx,
                                          D(0, 1) * yx + D(2, 2) * xy, D(1, 1) * yy + D(2, 2) * xx};
        for (const unsigned c : {0u, 1u})
          for (const unsigned d : {0u, 1u}) {
            const unsigned i = place(a, c), j = place(b, d);
            K(i, j) += block[2 * c + d];
            if (a != b) K(j, i) += block[2 * c + d];
          }
      }
  }

  unsigned place(unsigned node, unsigned component) const {
    return system_.component_to_system_index(component, node);
  }

  void assemble() {
    using namespace dealii;
    const Mat3 D = problem_.elasticity();
    Mat3 volumetric = Mat3::Zero();
    volumetric.topLeftCorner<2, 2>().setConstant(D(0, 1));
    const auto& body_force = problem_.solution.body_force;
    const UpdateFlags needed = update_gradients | update_JxW_values;
    FEValues<2> values(mapping_, *choice_.element, choice_.rule,
                       body_force ? needed | update_values | update_quadrature_points : needed);
    std::optional<FEValues<2>> reduced;
    if (choice_.volumetric_rule)
      reduced.emplace(mapping_, *choice_.element, *choice_.volumetric_rule, needed);
    const QGauss<1> face_rule(choice_.element->degree + 1);
    FEFaceValues<2> face_values(
        mapping_, *choice_.element, face_rule,
        update_values | update_JxW_values | update_normal_vectors | update_quadrature_points);
    const unsigned n = system_.n_dofs_per_cell(), n_nodes = choice_.element->n_dofs_per_cell();
    FullMatrix<double> K(n, n);
    Vector<double> f(n);
    std::vector<types::global_dof_index> unknowns(n);
    for (const auto& cell : dof_handler_.active_cell_iterators()) {
      K = 0;
      f = 0;
      const typename Triangulation<2>::cell_iterator shape = cell;
      values.reinit(shape);
      add_stiffness(values, reduced ? Mat3(D - volumetric) : D, K);
      if (reduced) {
        reduced->reinit(shape);
        add_stiffness(*reduced, volumetric, K);
      }
      if (body_force)
        for (const unsigned q : values.quadrature_point_indices())
          add_load(values, q, body_force(vector_of(values.quadrature_point(q))), n_nodes, f);
      if (cell->at_boundary())
        for (const unsigned face : cell->face_indices())
          if (cell->face(face)->at_boundary() && (cell->face(face)->boundary_id() & 4)) {
            face_values.reinit(shape, face);
            for (const unsigned q : face_values.quadrature_point_indices())
              add_load(face_values, q,
                       problem_.traction(vector_of(face_values.quadrature_point(q)),
                                         vector_of(face_values.normal_vector(q))),
                       n_nodes, f);
          }
      cell->get_dof_indices(unknowns);
      constraints_.distribute_local_to_global(K, f, unknowns, matrix_, load_);
    }
  }

  void add_load(const dealii::FEValuesBase<2>& values, unsigned q, const Vec2& force, unsigned n_nodes,
                dealii::Vector<double>& f) const {
    for (unsigned a = 0; a < n_nodes; ++a)
      for (const unsigned c : {0u, 1u}) f[place(a, c)] += values.shape_value(a, q) * values.JxW(q) * force[c];
  }

  Stages solve_by_umfpack() {
    Stages stages = stages_;
    StopWatch watch;
    dealii::SparseDirectUMFPACK factor;
    factor.factorize(matrix_);
    stages.factorization = watch.lap();
    solution_ = load_;
    factor.solve(solution_);
    constraints_.distribute(solution_);
    stages.solve = watch.lap();
    return stages;
  }

  Stages solve_by_cholesky() const {
    const polyfem::SparseMatrix lower = lower_triangle();
    const polyfem::VectorXd b = Eigen::Map<const polyfem::VectorXd>(load_.begin(), lower.rows());
    polyfem::VectorXd x;
    Stages stages = stages_;
    StopWatch watch;
    polyfem::Cholesky factor;
    factor.analyze(lower);
    if (!factor.factorize(lower)) throw polyfem::Error("deal.II's matrix is not positive definite");
    stages.factorization = watch.lap();
    factor.solve(b, x);
    dealii::Vector<double> solution(x.begin(), x.end());
    constraints_.distribute(solution);
    stages.solve = watch.lap();
    solution -= solution_;
    if (solution.linfty_norm() > 1e-6 * solution_.linfty_norm())
      throw polyfem::Error("UMFPACK and CHOLMOD differ");
    return stages;
  }

  Stages solve_by_cg() const {
    Stages stages = stages_;
    StopWatch watch;
    dealii::PreconditionSSOR<dealii::SparseMatrix<double>> preconditioner;
    preconditioner.initialize(matrix_, 1.5);
    stages.factorization = watch.lap();
    dealii::SolverControl control(20000, 1e-8 * load_.l2_norm());
    dealii::SolverCG<dealii::Vector<double>> cg(control);
    dealii::Vector<double> x(load_.size());
    cg.solve(matrix_, x, load_, preconditioner);
    constraints_.distribute(x);
    stages.solve = watch.lap();
    return stages;
  }

  polyfem::SparseMatrix lower_triangle() const {
    std::vector<Eigen::Triplet<double, int>> entries;
    for (unsigned row = 0; row < matrix_.m(); ++row)
      for (auto entry = matrix_.begin(row); entry != matrix_.end(row); ++entry)
        if (entry->column() <= row)
          entries.emplace_back(static_cast<int>(row), static_cast<int>(entry->column()), entry->value());
    const auto n = static_cast<polyfem::Index>(matrix_.m());
    polyfem::SparseMatrix lower(n, n);
    lower.setFromTriplets(entries.begin(), entries.end());
    return lower;
  }

  Accuracy accuracy(bool with_errors) const {
    Accuracy result;
    result.n_unknowns = static_cast<int>(dof_handler_.n_dofs());
    result.work = load_ * solution_;
    if (problem_.exact() && with_errors) measure_errors(result);
    if (!problem_.exact())
      for (const auto& cell : dof_handler_.active_cell_iterators())
        for (const unsigned v : cell->vertex_indices())
          if ((vector_of(cell->vertex(v)) - problem_.watched).norm() < 1e-9)
            result.watched = solution_[cell->vertex_dof_index(v, 1)];
    return result;
  }

  void measure_errors(Accuracy& result) const {
    using namespace dealii;
    const Mat3 D = problem_.elasticity(), flexibility = D.inverse();
    FEValues<2> values(mapping_, system_, choice_.error_rule,
                       update_values | update_gradients | update_JxW_values | update_quadrature_points);
    const unsigned n_points = values.n_quadrature_points;
    std::vector<Vector<double>> u(n_points, Vector<double>(2));
    std::vector<std::vector<Tensor<1, 2>>> grad(n_points, std::vector<Tensor<1, 2>>(2));
    double l2 = 0, l2_all = 0, energy = 0, energy_all = 0;
    for (const auto& cell : dof_handler_.active_cell_iterators()) {
      values.reinit(cell);
      values.get_function_values(solution_, u);
      values.get_function_gradients(solution_, grad);
      double dilatation = 0, area = 0;
      for (unsigned q = 0; q < n_points; ++q) {
        dilatation += values.JxW(q) * (grad[q][0][0] + grad[q][1][1]);
        area += values.JxW(q);
      }
      for (unsigned q = 0; q < n_points; ++q) {
        const Vec2 x = vector_of(values.quadrature_point(q)), exact = problem_.solution.displacement(x);
        const Vec3 exact_strain = flexibility * problem_.solution.stress(x);
        Vec3 strain(grad[q][0][0], grad[q][1][1], grad[q][0][1] + grad[q][1][0]);
        if (problem_.nearly_incompressible)
          strain.head<2>().array() += (dilatation / area - strain[0] - strain[1]) / 2;
        strain -= exact_strain;
        l2 += values.JxW(q) * (exact - vector_of(u[q])).squaredNorm();
        l2_all += values.JxW(q) * exact.squaredNorm();
        energy += values.JxW(q) * strain.dot(D * strain);
        energy_all += values.JxW(q) * exact_strain.dot(D * exact_strain);
      }
    }
    result.l2 = std::sqrt(l2 / l2_all);
    result.energy = std::sqrt(energy / energy_all);
  }

  const Problem& problem_;
  Choice choice_;
  dealii::FESystem<2> system_;
  const dealii::Mapping<2>& mapping_;
  dealii::Triangulation<2> triangulation_;
  dealii::DoFHandler<2> dof_handler_;
  dealii::AffineConstraints<double> constraints_;
  dealii::SparsityPattern pattern_;
  dealii::SparseMatrix<double> matrix_;
  dealii::Vector<double> load_, solution_;
  Stages stages_;  ///< up to the matrix
};

}  // namespace

Run run_deal_ii(const Problem& problem, const polyfem::PolygonMesh& mesh, DealIIElement element, bool with_cg,
                bool with_errors) {
  dealii::MultithreadInfo::set_thread_limit(1);
  return Discretization(problem, mesh, element).solve(with_cg, with_errors);
}

}  // namespace work_precision
