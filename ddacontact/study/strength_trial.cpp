#include <ddacontact/study/strength_trial.hpp>

#include <ddacontact/output/run_verdict.hpp>

#include <algorithm>
#include <cstdio>

namespace ddacontact {

namespace {

/// A block has moved with the first one when it went this part of its way, both in sizes of the block.
constexpr double part_of_mechanism = 0.1;

std::string figure(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

/// How far the blocks are from where they were.
class Way {
 public:
  explicit Way(const Stepper& stepper)
      : stepper_(stepper), start_(stepper.blocks().displacements(stepper.state())) {}

  Points of_vertices() const { return stepper_.blocks().displacements(stepper_.state()) - start_; }
  /// Of each block the furthest vertex, m.
  std::vector<double> of_blocks() const {
    const BlockSystem& blocks = stepper_.blocks();
    const Points moved = of_vertices();
    std::vector<double> furthest(static_cast<std::size_t>(blocks.n_blocks()), 0);
    for (int b = 0; b < blocks.n_blocks(); ++b) {
      if (!blocks.is_present(b)) continue;
      const Range& v = blocks.block(b).vertices();
      furthest[b] = moved.middleCols(v.first, v.count).colwise().norm().maxCoeff();
    }
    return furthest;
  }

  /// In sizes of its block.
  double relative(const std::vector<double>& ways, int b) const {
    return ways[b] / stepper_.blocks().block(b).size();
  }
  /// The block that went furthest, in its sizes.
  int furthest(const std::vector<double>& ways) const {
    int first = 0;
    for (int b = 1; b < stepper_.blocks().n_blocks(); ++b)
      if (relative(ways, b) > relative(ways, first)) first = b;
    return first;
  }

 private:
  const Stepper& stepper_;
  Points start_;
};

void describe_end(const Stepper& stepper, const Way& way, double start_time, StrengthTrial& trial) {
  const std::vector<double> ways = way.of_blocks();
  trial.max_displacement = *std::max_element(ways.begin(), ways.end());
  trial.kinetic = stepper.equilibrium().kinetic;
  trial.unbalanced = stepper.equilibrium().unbalanced;
  trial.time = stepper.state().time - start_time;
  trial.displacements = way.of_vertices();
  trial.pulled_bonds = describe_pulled_bonds(stepper);
  trial.broken_bonds = stepper.counts().broken_bonds;
  const int first = way.furthest(ways);
  if (ways[first] == 0) return;
  trial.first_block = first;
  for (int b = 0; b < stepper.blocks().n_blocks(); ++b)
    if (way.relative(ways, b) >= part_of_mechanism * way.relative(ways, first))
      trial.moved_blocks.push_back(b);
}

}  // namespace

StrengthTrial run_trial(Stepper& stepper, const TrialLimits& limits, const std::function<bool()>& given_up) {
  stepper.interrupt_when(given_up);
  StrengthTrial trial;
  const Way way(stepper);
  const double start_time = stepper.state().time;
  const auto decide = [&](Verdict verdict, std::string reason) {
    trial.verdict = verdict;
    trial.reason = std::move(reason);
    describe_end(stepper, way, start_time, trial);
    return trial;
  };
  const long stage_steps = std::max(stepper.stages().back().analysis.steps, limits.fewest_steps),
             most_steps = limits.time_factor * stage_steps;
  double first_half = 0, second_half = 0;
  long unchanged = 0;  // steps since the last change
  int at_rest = 0, slipped = 0;
  const auto changes = [&] { return stepper.state().time < last_change(stepper.blocks()); };
  while (unchanged < most_steps) {
    if (given_up && given_up()) return decide(Verdict::stopped, "interrupted");
    if (!stepper.step()) return decide(Verdict::stopped, stepper.stop_reason());
    ++trial.steps;
    unchanged = changes() ? 0 : unchanged + 1;
    const Equilibrium& e = stepper.equilibrium();
    const std::vector<double> ways = way.of_blocks();
    const double relative = way.relative(ways, way.furthest(ways));
    const bool rests = e.in_balance() && e.relative_speed <= limits.rest_speed;
    at_rest = rests && unchanged > 0 ? at_rest + 1 : 0;
    if (at_rest >= limits.steps_at_rest && relative > limits.slip)
      return decide(Verdict::moves, "at rest after a vertex went further than " + figure(limits.slip) +
                                        " sizes of its block");
    if (at_rest >= limits.steps_at_rest)
      return decide(Verdict::rests, "forces in balance, no vertex faster than " + figure(limits.rest_speed) +
                                        " sizes of its block a second");
    if (relative > limits.displacement && !e.in_balance())
      return decide(Verdict::moves, "a vertex further than " + figure(limits.displacement) +
                                        " sizes of its block, forces out of balance by " +
                                        figure(e.unbalanced));
    slipped = relative > limits.slip ? slipped + 1 : 0;
    if (slipped >= stage_steps / 2)
      return decide(Verdict::moves, "a vertex further than " + figure(limits.slip) +
                                        " sizes of its block for " + std::to_string(slipped) +
                                        " steps in a row");
    double& furthest = unchanged <= most_steps / 2 ? first_half : second_half;
    furthest = std::max(furthest, relative);
  }
  const std::string when = " in the last " + std::to_string(most_steps / 2) + " steps";
  return second_half <= first_half ? decide(Verdict::rests, "no vertex went further" + when)
                                   : decide(Verdict::moves, "vertices went further" + when);
}

}  // namespace ddacontact
