/// \file Linear dynamics in time, M u'' + K u = f, by Newmark's scheme.
#pragma once

#include <polyfem/assembly/time_matrices.hpp>

#include <vector>

namespace polyfem {

/// With the predictor p = u_n + dt v_n + dt^2 (1/2 - beta) a_n,
///     (K + M / (beta dt^2)) u_n+1 = f + M p / (beta dt^2),
///     a_n+1 = (u_n+1 - p) / (beta dt^2),    v_n+1 = v_n + dt ((1 - gamma) a_n + gamma a_n+1)
/// (Hughes, section 9.1). (1/4, 1/2), the default, is of second order, stable for any dt and keeps the energy
/// of vibration; gamma > 1/2 damps. One factor serves all steps with the same set of prescribed degrees of
/// freedom.
class NewmarkScheme {
 public:
  /// Of the scheme; those of average acceleration are the default.
  struct Parameters {
    double beta = 0.25, gamma = 0.5;
  };

  /// \param[in] mesh  kept by reference, as by `FieldProblem`, which throws for what is wrong with it
  /// Throws Error unless time_step > 0, gamma >= 1/2 and 2 beta >= gamma, beyond which long steps are
  /// unstable.
  NewmarkScheme(const PolygonMesh& mesh, int n_components, const CellMatrices& cell_matrices,
                double time_step, const Parameters& parameters);
  NewmarkScheme(const PolygonMesh& mesh, int n_components, const CellMatrices& cell_matrices,
                double time_step)
      : NewmarkScheme(mesh, n_components, cell_matrices, time_step, Parameters{}) {}
  NewmarkScheme(PolygonMesh&&, int, const CellMatrices&, double, const Parameters&) = delete;
  NewmarkScheme(PolygonMesh&&, int, const CellMatrices&, double) = delete;

  /// Prescribes an unknown at the end of further steps; once more to change its value.
  void hold(int vertex, int component, double value = 0) { effective_.hold(vertex, component, value); }
  /// As those of `FieldProblem`, at the end of further steps.
  void tie(int vertex, int component, const std::vector<Followed>& followed, double constant = 0) {
    effective_.tie(vertex, component, followed, constant);
  }
  void roll(int vertex, const Vec2& normal, double value = 0) { effective_.roll(vertex, normal, value); }
  /// Sets displacements and velocities, zero at first, and the loads at that time beyond those of the cells.
  /// Accelerations follow from M a = f - K u; those of unknowns that are held so far are zero, tied ones
  /// follow others. Call it after `hold`, and also to start from rest where loads act. Throws Error for
  /// another size.
  void start(const VectorXd& u, const VectorXd& v, const VectorXd& loads);

  /// Goes on by one step; `loads`, beyond those of the cells, are those at its end.
  void step(const VectorXd& loads);
  void step() { step(VectorXd::Zero(u_.size())); }

  const VectorXd& displacements() const { return u_; }
  const VectorXd& velocities() const { return v_; }
  const VectorXd& accelerations() const { return a_; }
  /// Kinetic and elastic energy, v.Mv / 2 + u.Ku / 2.
  double energy() const;
  double time() const { return n_steps_ * time_step_; }
  const TimeMatrices& matrices() const { return matrices_; }

 private:
  double time_step_;
  Parameters parameters_;
  FieldProblem effective_;
  TimeMatrices matrices_;
  VectorXd u_, v_, a_;
  int n_steps_ = 0;
};

}  // namespace polyfem
