#include <ddacontact/solver/friction_bounds.hpp>

#include <ddacontact/solver/anderson.hpp>
#include <ddacontact/solver/friction_problem.hpp>

#include <algorithm>

namespace ddacontact {

bool iterate_bounds(const std::function<void(const VectorXd& bounds, VectorXd& wanted)>& solve,
                    VectorXd& bounds) {
  constexpr double tolerance = 1e-9;
  constexpr int max_solves = MinimizeOptions{}.max_iterations, anderson_depth = 5, patience = 8;
  constexpr double sufficient_decrease = 0.8;
  AndersonAcceleration acceleration(anderson_depth);
  VectorXd wanted = bounds, next = bounds;
  bool accelerated = true;
  double damping = 0.5, least = inf;
  for (int solves = 0, solves_without_gain = 0; solves < max_solves; ++solves) {
    bounds = next;
    solve(bounds, wanted);
    const VectorXd change = wanted - bounds;
    const double difference = change.size() ? change.cwiseAbs().maxCoeff() : 0;
    if (difference == 0 || difference <= tolerance * bounds.cwiseMax(wanted).maxCoeff()) return true;

    solves_without_gain = difference < sufficient_decrease * least ? 0 : solves_without_gain + 1;
    least = std::min(least, difference);
    if (solves_without_gain == patience) {
      solves_without_gain = 0;
      accelerated = !accelerated;
      acceleration.reset();
      if (accelerated) damping /= 2;
    }
    if (accelerated) {
      next = wanted;
      acceleration.advance(change, next);
    } else {
      next += damping * change;
    }
    next = next.cwiseMax(0);
  }
  return false;
}

}  // namespace ddacontact
