/// \file Heat conduction and its like in time, M u' + K u = f, by the theta scheme.
#pragma once

#include <polyfem/assembly/time_matrices.hpp>

#include <vector>

namespace polyfem {

/// (M + theta dt K) u_n+1 = M u_n - (1 - theta) dt K u_n + dt f (Hughes, section 8.1). theta = 1/2
/// (Crank-Nicolson) is of second order, theta = 1 (backward Euler) of first order and without oscillations;
/// both are stable for any dt. One factor serves all steps with the same set of prescribed degrees of
/// freedom.
class ThetaScheme {
 public:
  /// \param[in] mesh  kept by reference, as by `FieldProblem`, which throws for what is wrong with it
  /// Throws Error unless time_step > 0 and 1/2 <= theta <= 1.
  ThetaScheme(const PolygonMesh& mesh, int n_components, const CellMatrices& cell_matrices, double time_step,
              double theta);
  ThetaScheme(PolygonMesh&&, int, const CellMatrices&, double, double) = delete;

  /// Prescribes an unknown at the end of further steps; once more to change its value.
  void hold(int vertex, int component, double value = 0) { effective_.hold(vertex, component, value); }
  /// As those of `FieldProblem`, at the end of further steps.
  void tie(int vertex, int component, const std::vector<Followed>& followed, double constant = 0) {
    effective_.tie(vertex, component, followed, constant);
  }
  /// Sets u, zero at first; throws Error for another size.
  void set_solution(const VectorXd& u);

  /// Goes on by one step; `loads`, beyond those of the cells, are those at t + theta dt.
  const VectorXd& step(const VectorXd& loads);
  const VectorXd& step() { return step(VectorXd::Zero(u_.size())); }

  const VectorXd& solution() const { return u_; }
  double time() const { return n_steps_ * time_step_; }
  const TimeMatrices& matrices() const { return matrices_; }

 private:
  double time_step_, theta_;
  FieldProblem effective_;  ///< K + M / (theta dt)
  TimeMatrices matrices_;
  VectorXd u_;
  int n_steps_ = 0;
};

}  // namespace polyfem
