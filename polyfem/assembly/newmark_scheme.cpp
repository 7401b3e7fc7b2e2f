#include <polyfem/assembly/newmark_scheme.hpp>

#include <polyfem/core/error.hpp>

namespace polyfem {
namespace {

double checked_mass_factor(double time_step, const NewmarkScheme::Parameters& parameters) {
  if (!(time_step > 0) || !(parameters.gamma >= 0.5) || !(2 * parameters.beta >= parameters.gamma))
    throw Error(
        "Newmark's scheme: the time step must be above 0, gamma at least 1/2 and beta at least gamma / 2: "
        "otherwise long steps are unstable");
  return 1 / (parameters.beta * time_step * time_step);
}

}  // namespace

NewmarkScheme::NewmarkScheme(const PolygonMesh& mesh, int n_components, const CellMatrices& cell_matrices,
                             double time_step, const Parameters& parameters)
    : time_step_(time_step),
      parameters_(parameters),
      effective_(mesh, n_components),
      matrices_(mesh, n_components, cell_matrices, checked_mass_factor(time_step, parameters), effective_),
      u_(VectorXd::Zero(effective_.n_unknowns())),
      v_(u_),
      a_(u_) {}

void NewmarkScheme::start(const VectorXd& u, const VectorXd& v, const VectorXd& loads) {
  if (u.size() != u_.size() || v.size() != u_.size() || loads.size() != u_.size())
    throw Error("Newmark's scheme: there are " + std::to_string(u_.size()) +
                " unknowns: give a displacement, a velocity and a load for each");
  u_ = u;
  v_ = v;
  PrescribedDofs prescribed(effective_.n_unknowns());
  for (int k = 0; k < effective_.n_unknowns(); ++k)
    if (effective_.is_prescribed(k)) prescribed.hold(k, 0);
  TiedUnknowns tied;  // accelerations follow by the same factors, without constants
  for (const auto& [unknown, tie] : effective_.tied().ties()) tied.tie(unknown, tie.terms, 0);
  ReducedSystem system;
  if (!system.set(matrices_.mass().selfadjointView<Eigen::Lower>(),
                  tied.reduce(prescribed, effective_.n_unknowns()), true))
    throw Error(
        "Newmark's scheme: the mass matrix is not positive definite; give every cell a density above 0 "
        "and a rule without negative weights");
  a_ = system.solve(matrices_.loads() + loads - matrices_.stiffness_times(u));
}

void NewmarkScheme::step(const VectorXd& loads) {
  const double dt = time_step_, per_step = 1 / (parameters_.beta * dt * dt);
  const VectorXd predictor = u_ + dt * v_ + dt * dt * (0.5 - parameters_.beta) * a_;
  effective_.clear_loads();
  effective_.add_loads(matrices_.loads() + loads + per_step * matrices_.mass_times(predictor));
  u_ = effective_.solve();
  const VectorXd acceleration = per_step * (u_ - predictor);
  v_ += dt * ((1 - parameters_.gamma) * a_ + parameters_.gamma * acceleration);
  a_ = acceleration;
  ++n_steps_;
}

double NewmarkScheme::energy() const {
  return (v_.dot(matrices_.mass_times(v_)) + u_.dot(matrices_.stiffness_times(u_))) / 2;
}

}  // namespace polyfem
