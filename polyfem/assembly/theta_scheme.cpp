#include <polyfem/assembly/theta_scheme.hpp>

#include <polyfem/core/error.hpp>

namespace polyfem {
namespace {

double checked_mass_factor(double time_step, double theta) {
  if (!(time_step > 0) || !(theta >= 0.5 && theta <= 1))
    throw Error(
        "theta scheme: the time step must be above 0, theta between 1/2 and 1; below 1/2 long steps are "
        "unstable");
  return 1 / (theta * time_step);
}

}  // namespace

ThetaScheme::ThetaScheme(const PolygonMesh& mesh, int n_components, const CellMatrices& cell_matrices,
                         double time_step, double theta)
    : time_step_(time_step),
      theta_(theta),
      effective_(mesh, n_components),
      matrices_(mesh, n_components, cell_matrices, checked_mass_factor(time_step, theta), effective_),
      u_(VectorXd::Zero(effective_.n_unknowns())) {}

void ThetaScheme::set_solution(const VectorXd& u) {
  if (u.size() != u_.size())
    throw Error("theta scheme: there are " + std::to_string(u_.size()) + " unknowns, not " +
                std::to_string(u.size()) + ": give a value for each");
  u_ = u;
}

const VectorXd& ThetaScheme::step(const VectorXd& loads) {
  effective_.clear_loads();
  effective_.add_loads((matrices_.mass_times(u_) / time_step_ - (1 - theta_) * matrices_.stiffness_times(u_) +
                        matrices_.loads() + loads) /
                       theta_);
  u_ = effective_.solve();
  ++n_steps_;
  return u_;
}

}  // namespace polyfem
