/// \file Nonlinear equilibrium on a mesh by Newton's method, in load steps.
#pragma once

#include <polyfem/assembly/field_problem.hpp>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace polyfem {

/// How Newton's method ended.
struct NewtonReport {
  bool converged = false;
  /// Largest force out of balance over the largest force of any cell or load, at the start of each iteration
  /// and at the end.
  std::vector<double> residuals;
  std::string reason;  ///< of not converging: where, and the cure
};

/// Newton's method for forces(u) = t loads, with a load factor t and prescribed degrees of freedom at t times
/// their values.
///
///     NonlinearProblem problem(mesh, 2, forces_of_cell);
///     for (double t : {0.25, 0.5, 0.75, 1.})
///       if (const NewtonReport report = problem.solve(t); !report.converged) ...
///
/// Each solution starts from the last one that converged, u = 0 at first. Steps are halved while they turn
/// a cell inside out or leave more residual than the last three (line search). Symmetric tangents must be
/// positive definite near a solution: stable equilibria. Those without symmetry, as of materials whose flow
/// is not associated, are stated as such and have to be regular; so are symmetric ones that are not definite
/// on the way, as of materials that soften, or nearly incompressible ones under large strains.
class NonlinearProblem {
 public:
  /// Fills the tangent K = d forces / d u (square, symmetric) and the forces of a cell at displacements u of
  /// its vertices. What it throws (a cell turned inside out) makes a step too long.
  using CellForces = std::function<void(int cell, const PointsRef& polygon, const VectorXd& u, MatrixXd& K,
                                        VectorXd& forces)>;

  /// \param[in] mesh  kept by reference, as by `FieldProblem`, which throws for what is wrong with it
  NonlinearProblem(const PolygonMesh& mesh, int n_components, CellForces cell_forces,
                   Symmetry symmetry = Symmetry::symmetric);
  NonlinearProblem(PolygonMesh&&, int, CellForces, Symmetry = Symmetry::symmetric) = delete;

  /// As those of `FieldProblem`, at t = 1. Loads are dead: they keep direction and size.
  void hold(int vertex, int component, double value = 0);
  void tie(int vertex, int component, const std::vector<Followed>& followed, double constant = 0);
  void roll(int vertex, const Vec2& normal, double value = 0);
  void add_load(int vertex, int component, double value);
  template <std::size_t n>
  void add_edge_loads(const std::vector<std::array<int, n>>& edges, const FieldProblem::EdgeLoad& load) {
    linear_.clear_loads();
    linear_.add_edge_loads(edges, load);
    loads_ += linear_.loads();
  }

  /// Solves at load factor t until the residual is below `tolerance`. Not converged, within 25 iterations or
  /// as the tangent is not positive definite, is reported; the solution is the last converged one then. With
  /// assertions on, each iteration compares the tangent of a cell where the residual is largest with
  /// differences of its forces, and one that is off by 5 % is reported.
  NewtonReport solve(double t, double tolerance = 1e-10);

  /// The last converged solution.
  const VectorXd& solution() const { return u_; }
  /// How far a cell's tangent is from central differences of its forces at a field u, relative to the
  /// tangent: about 1e-8 of a correct one, unless a material yields in between. Throws Error for a cell that
  /// is not there.
  double tangent_error(int cell, const VectorXd& u) const;

 private:
  struct Residual {
    double relative;
    int worst_unknown;
  };
  Residual assemble(const VectorXd& u, double t);
  void remember_tie(int vertex, int component);
  /// Makes what is held or tied go in one step where it is at load factor t. False: it is there.
  bool prescribe(const VectorXd& u, double t);
  VectorXd of_cell(int cell, const VectorXd& u) const;
  const VectorXd& solve_linear();
  /// Throws Error when the tangent of a cell at this vertex is not the derivative of its forces.
  void require_derivative(int vertex, const VectorXd& u) const;
  std::string failure(const Residual& residual, const VectorXd& u) const;

  const PolygonMesh* mesh_;
  int n_components_;
  CellForces cell_forces_;
  FieldProblem linear_;  ///< of an iteration
  TiedUnknowns tied_;    ///< at t = 1
  VectorXd loads_, prescribed_values_, u_;
};

}  // namespace polyfem
