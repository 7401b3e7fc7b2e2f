// Contact methods on steps that are hard on them.
//   hard_steps              the table of methods over tests/hard_steps, in Markdown
//   hard_steps collect DIR  records the hardest steps of drops and of scenes made for it
//   hard_steps drops N      N random drops: what they took, and what was rejected
#include <tests/support/hard_steps.hpp>
#include <tests/support/made_scenes.hpp>
#include <tests/support/random_scenes.hpp>

#include <polyfem/core/stopwatch.hpp>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <iostream>
#include <map>

namespace {

using namespace ddacontact;
using namespace support;

/// Mechanical energy that grows in a step by more than this part of the kinetic energy is counted.
constexpr double energy_rise = 1e-6;

struct Method {
  const char* name;
  ContactMethod method;
  bool inside;
  bool all_agree;
};

/// What a method does with the recorded steps.
struct Outcome {
  int solved = 0, attempted = 0;
  long solutions = 0, most = 0, factorizations = 0;
  double seconds = 0, residual = 0;
};

Outcome try_steps(const Method& method, const std::vector<HardStep>& steps) {
  Outcome outcome;
  for (HardStep step : steps) {
    step.scene.contact.method = method.method;
    if (method.method == ContactMethod::classic) step.scene.contact.penetration_tolerance = 0;
    step.scene.analysis.cutting_factor = 1e-4;  // the first rejected try is the last
    const BuiltScene built = build_at(step);
    Stepper& stepper = *built.stepper;
    stepper.contact_solver_options().interior_point = method.inside;
    bool made;
    {
      const polyfem::Stopwatch watch(outcome.seconds);
      made = stepper.step();
    }
    const StepCounts& counts = stepper.counts();
    ++outcome.attempted;
    outcome.solved += made && !(method.all_agree && counts.unconverged > 0);
    outcome.solutions += counts.contact_iterations;
    outcome.most = std::max(outcome.most, counts.contact_iterations);
    outcome.factorizations += stepper.counts().factorizations;
    outcome.residual = std::max(outcome.residual, counts.max_residual);
  }
  return outcome;
}

void print_table() {
  const std::vector<HardStep> steps = hard_steps();
  const Method methods[] = {
      {"classic, stick and slip as they may be", ContactMethod::classic, true, false},
      {"classic, all states settled", ContactMethod::classic, true, true},
      {"staged, active-set iteration alone", ContactMethod::staged, false, false},
      {"staged", ContactMethod::staged, true, false},
  };
  std::printf(
      "# Contact methods on hard steps\n\n"
      "%zu recorded steps (`tests/hard_steps`); written by `build/tests/performance/hard_steps`.\n"
      "Solved is a step made without a rejected try, in the pieces that the motion asks for.\n"
      "The residual is the largest over the accepted steps of what is left of the forces on a block, "
      "relative to the sum of their magnitudes.\n\n"
      "| method | solved | solutions a step | most | factorizations a step | ms a step | residual |\n"
      "|---|---|---|---|---|---|---|\n",
      steps.size());
  for (const Method& method : methods) {
    const Outcome o = try_steps(method, steps);
    std::printf("| %s | %d of %d | %.1f | %ld | %.1f | %.2f | %.1e |\n", method.name, o.solved, o.attempted,
                static_cast<double>(o.solutions) / o.attempted, o.most,
                static_cast<double>(o.factorizations) / o.attempted, 1e3 * o.seconds / o.attempted,
                o.residual);
  }
}

/// The step of a run that took most solutions is recorded when it took more than `least`.
void collect_from(const Scene& scene, const std::string& name, long least,
                  const std::filesystem::path& directory) {
  const BuiltScene built = build(scene);
  Stepper& stepper = *built.stepper;
  StepRecord hardest;
  long most = least;
  for (int k = 0; k < scene.analysis.steps; ++k) {
    StepRecord before = stepper.record();
    const long solutions = stepper.counts().contact_iterations;
    const bool made = stepper.step();
    if (stepper.counts().contact_iterations - solutions > most) {
      most = stepper.counts().contact_iterations - solutions;
      hardest = std::move(before);
    }
    if (!made) break;
  }
  if (most > least) write_hard_step(directory / (name + ".step"), scene, hardest);
}

void run_drops(int n) {
  struct Sum {
    long drops = 0, steps = 0, substeps = 0, rejected = 0, interior_point_solves = 0, stopped = 0, rises = 0;
    double residual = 0, overlap = 0, rise = 0;
  };
  std::map<std::string, Sum> sums;
  for (int seed = 0; seed < n; ++seed) {
    const Scene scene = random_drop(static_cast<std::uint64_t>(seed));
    const BuiltScene built = build(scene);
    const Energy& energy = built.stepper->energy().now;
    bool made = true;
    long rises = 0;
    double overlap = 0, rise = 0, before = energy.kinetic + energy.elastic + energy.gravity,
           largest = energy.kinetic;
    for (int k = 0; k < scene.analysis.steps && made; ++k) {
      made = built.stepper->step();
      const double now = energy.kinetic + energy.elastic + energy.gravity;
      largest = std::max(largest, energy.kinetic);
      rises += now - before > energy_rise * largest;
      if (largest > 0) rise = std::max(rise, (now - before) / largest);
      before = now;
      if (k % 10 == 0) overlap = std::max(overlap, largest_overlap(*built.stepper));
    }
    const StepCounts& counts = built.stepper->counts();
    for (const std::string& name :
         {name_of(drop_kind(static_cast<std::uint64_t>(seed))), std::string("~all")}) {
      Sum& sum = sums[name];
      ++sum.drops;
      sum.steps += counts.steps;
      sum.substeps += counts.substeps;
      sum.rejected += counts.rejected;
      sum.interior_point_solves += counts.interior_point_solves;
      sum.stopped += !made;
      sum.rises += rises;
      sum.residual = std::max(sum.residual, counts.max_residual);
      sum.overlap = std::max(sum.overlap, overlap);
      sum.rise = std::max(sum.rise, rise);
    }
  }
  std::printf(
      "\n## Random drops\n\n"
      "The first %d drops, written by `build/tests/performance/hard_steps drops %d`. Stopped is a run that "
      "ended "
      "early. A rise is a step after which kinetic, elastic and potential energy together are larger by more "
      "than %g of the largest kinetic energy so far. The overlap is the largest common area of two blocks, "
      "relative to the smaller one, after every tenth step.\n\n"
      "| drops of | drops | steps | substeps | rejected | %% | stopped | stage 1 | residual | overlap | "
      "rises | largest |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      n, n, energy_rise);
  for (const auto& [name, s] : sums)
    std::printf("| %s | %ld | %ld | %ld | %ld | %.2f | %ld | %ld | %.1e | %.1e | %ld | %.1e |\n",
                name == "~all" ? "all" : name.c_str(), s.drops, s.steps, s.substeps, s.rejected,
                100. * static_cast<double>(s.rejected) / static_cast<double>(s.substeps + s.rejected),
                s.stopped, s.interior_point_solves, s.residual, s.overlap, s.rises, s.rise);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  if (what == "collect" && argc == 3) {
    for (const auto& [name, scene] : made_scenes()) collect_from(scene, name, 0, argv[2]);
    // Of piles there are more than enough.
    for (std::uint64_t seed = 0; seed < 300; ++seed)
      if (drop_kind(seed) != DropKind::pile || seed < 60)
        collect_from(random_drop(seed), name_of(drop_kind(seed)) + '_' + std::to_string(seed), 150, argv[2]);
  } else if (what == "drops" && argc == 3) {
    run_drops(std::atoi(argv[2]));
  } else if (argc == 1) {
    print_table();
  } else {
    std::cerr << "hard_steps [collect DIR | drops N]\n";
    return 2;
  }
}
