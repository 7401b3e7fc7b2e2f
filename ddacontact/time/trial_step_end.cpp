// Where a trial leads the blocks.
#include <ddacontact/core/for_all.hpp>
#include <ddacontact/core/quoted.hpp>
#include <ddacontact/time/trial_step.hpp>
#include <polyfem/geometry/validity.hpp>

#include <cmath>
#include <numbers>

namespace ddacontact {

namespace {

/// Why a block cannot go on with this outline, which is not convex; empty: it can.
std::string defect_of(const std::string& name, const PointsRef& outline) {
  if (!(polyfem::signed_area(outline) > 0))
    return "block " + quoted(name) + " is turned inside out: it is too soft for its loads";
  if (polyfem::find_defect(outline)) return "the outline of block " + quoted(name) + " crosses itself";
  return "";
}

}  // namespace

TrialEnd TrialStep::advance(double dt, const TrialSolution& solution) const {
  TrialEnd end{solution.impact.changes() ? solution.impact.start : state(), "", {}};
  BlockState& next = end.state;
  next.time += dt;
  system_->end(solution.straight, solution.residual.external, next);
  std::vector<char> is_concave(blocks().n_blocks(), 0);
  for_all(blocks().n_blocks(), [&](int b) {
    if (blocks().is_unchanging(b)) return;
    const Block& block = blocks().block(b);
    const auto outline = block.outline(next);
    is_concave[b] = polyfem::find_non_convex_corner(outline).has_value();
    const double angle = best_fit_rotation(block.reference().leftCols(outline.cols()), outline);
    next.rotation[b] += std::remainder(angle - state().rotation[b], 2 * std::numbers::pi);
  });
  for (int b = 0; b < blocks().n_blocks(); ++b) {
    if (!is_concave[b]) continue;
    end.rejection = defect_of(blocks().names[b], blocks().block(b).outline(next));
    if (!end.rejection.empty()) return end;
    end.concave.push_back(b);
  }
  const StepRule rule = this->rule(dt);
  next.carried_dt = rule.has_half_steps() && !is_static() ? dt : 0;
  set_supports(rule, next);
  if (is_static()) {  // after a static step blocks are at rest
    next.velocity.setZero();
    next.carried.setZero();
  } else if (rule.has_half_steps()) {
    next.velocity = next.carried;
  } else {
    set_support_velocities(rule, solution.d, next);
  }
  return end;
}

/// With half steps supports are where they should be to the bit, without the rounding of the motions.
void TrialStep::set_supports(const StepRule& rule, BlockState& next) const {
  if (!rule.has_half_steps()) return;
  for (const PrescribedDof& held : blocks().prescribed_dofs()) {
    const int b = blocks().block_of_unknown(held.unknown);
    if (blocks().is_unchanging(b)) continue;
    next.position(held.axis, held.vertex) = state().position(held.axis, held.vertex) +
                                            system_->prescribed()[held.unknown] +
                                            (state().origin(held.axis, b) - next.origin(held.axis, b));
  }
}

/// Schemes with constant or linear accelerations take the velocity of a support at the end of a step for what
/// it is: with a mean over the step, half a step late, d - dt v0 would make the inertia of what it drives
/// twice what its acceleration does. Backward Euler's velocities are those means.
void TrialStep::set_support_velocities(const StepRule& rule, const VectorXd& d, BlockState& next) const {
  for (const PrescribedDof& held : blocks().prescribed_dofs())
    next.velocity[held.unknown] =
        rule.scheme != Scheme::backward_euler && held.motion.is_history()
            ? held.motion.rate(held.axis, next.time, system_->dt(), blocks().end_time)
            : d[held.unknown] / system_->dt();
}

}  // namespace ddacontact
