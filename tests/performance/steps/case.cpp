#include "case.hpp"

#include "clock.hpp"
#include "factor_times.hpp"
#include "step_matrix.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <malloc.h>
#include <sys/resource.h>
#include <ddacontact/scene/builder.hpp>
#include <ddacontact/scene/schema.hpp>
#include <polyfem/assembly/blas.hpp>
#include <polyfem/core/parallel.hpp>
#include <tests/performance/scenes.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>

namespace step_performance {

namespace {

using namespace ddacontact;

/// Bytes of the heap in use, MB.
double heap() {
  const auto info = mallinfo2();
  return 1e-6 * static_cast<double>(info.uordblks + info.hblkhd);
}

void switch_off(Skips& skips, const std::string& name) {
  bool known = false;
  scene_format::describe(skips, [&](const scene_format::Key& key, bool& skip) {
    if (key.name != name) return;
    skip = false;
    known = true;
  });
  if (!known) throw polyfem::Error(fmt::format("there is no skip \"{}\"", name));
}

Scene scene_of(const Case& what) {
  Scene scene = performance::make_scene(what.scene, what.size);
  performance::set_time_step(scene, what.time_step);
  if (what.method == "classic") performance::make_classic(scene);
  if (what.method == "explicit") scene.analysis.scheme = Scheme::central_difference;
  if (what.method == "coarse") scene.contact.tolerance = 1e-3;
  for (const std::string& name : what.without) switch_off(scene.analysis.skip, name);
  if (what.settled) performance::settle_first(scene);
  return scene;
}

struct Phase {
  double Measurement::*seconds;
  double StepTimes::*of_stepper;
};
constexpr std::array phases{Phase{&Measurement::detection, &StepTimes::detection},
                            Phase{&Measurement::assembly, &StepTimes::assembly},
                            Phase{&Measurement::analysis, &StepTimes::analysis},
                            Phase{&Measurement::factorization, &StepTimes::factorization},
                            Phase{&Measurement::solution, &StepTimes::solution},
                            Phase{&Measurement::solver, &StepTimes::solver},
                            Phase{&Measurement::update, &StepTimes::update}};

/// Seconds of each step, in total and by phase.
class Samples {
 public:
  /// \param[in] total         of the step, s
  /// \param[in] by_the_clock  what the clock on the wall says it took, as it does of the stepper's phases
  void add(double total, double by_the_clock, const StepTimes& before, const StepTimes& after) {
    const auto share = [&](double StepTimes::*part) {
      return (after.*part - before.*part) * total / by_the_clock;
    };
    totals_.push_back(total);
    double rest = total;
    for (std::size_t p = 0; p < phases.size(); ++p) {
      double seconds = share(phases[p].of_stepper);
      if (phases[p].seconds == &Measurement::solver)
        for (const auto part : {&StepTimes::analysis, &StepTimes::factorization, &StepTimes::solution})
          seconds -= share(part);
      by_phase_[p].push_back(seconds);
      rest -= seconds;
    }
    rest_.push_back(rest);
  }

  void write(Measurement& row) const {
    row.steps = static_cast<double>(totals_.size());
    row.total = median(totals_);
    for (const double total : totals_) row.mean += total / row.steps;
    for (std::size_t p = 0; p < phases.size(); ++p) row.*phases[p].seconds = median(by_phase_[p]);
    row.rest = median(rest_);
  }

 private:
  std::vector<double> totals_, rest_;
  std::array<std::vector<double>, phases.size()> by_phase_;
};

void add_factor_times(Stepper& stepper, double most_mb, Measurement& row) {
  const polyfem::SparseMatrix matrix = step_matrix(stepper);
  const FactorTimes amd = cholmod_times(matrix, Ordering::amd, most_mb),
                    metis = cholmod_times(matrix, Ordering::metis, most_mb);
  row.amd_analysis = amd.analysis;
  row.amd_factorization = amd.factorization;
  row.amd_solution = amd.solution;
  row.amd_factor = amd.factor;
  row.metis_analysis = metis.analysis;
  row.metis_factorization = metis.factorization;
  row.metis_solution = metis.solution;
  row.metis_factor = metis.factor;
  if (row.cholmod() == 0) return;
  const FactorTimes own = own_times(matrix);
  row.own_analysis = own.analysis;
  row.own_factorization = own.factorization;
  row.own_solution = own.solution;
}

}  // namespace

Measurement row_of(const Case& what) {
  Measurement row;
  row.scene = what.scene;
  row.start = what.settled ? "settled" : "sudden";
  row.method = what.method;
  row.without = fmt::format("{}", fmt::join(what.without, " "));
  row.time_step = what.time_step;
  row.threads = what.threads;
  row.size = what.size;
  return row;
}

Measurement measure(const Case& what, const Effort& effort) {
  using Clock = std::chrono::steady_clock;
  const auto since = [](Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  polyfem::pin_blas_to_one_thread();
  polyfem::set_threads(what.threads);
  Measurement row = row_of(what);
  std::optional<Scene> scene = scene_of(what);
  int to_settle = 0;
  if (what.settled) to_settle = scene->stages.front().analysis.steps;
  const double heap_before = heap();
  const double setup_start = processor_time();
  const BuiltScene built = build(*scene);
  row.setup = processor_time() - setup_start;
  row.heap_blocks = heap() - heap_before;
  scene.reset();
  Stepper& stepper = *built.stepper;
  for (int b = 0; b < stepper.blocks().n_blocks(); ++b) row.blocks += !stepper.blocks().is_unchanging(b);
  row.unknowns = stepper.blocks().n_equations();

  Samples samples;
  StepCounts before_all;
  long analyses_before = 0;
  const double start = processor_time();
  const double heap_built = heap();
  for (int step = -to_settle - effort.warm_steps; step < effort.steps; ++step) {
    const bool late = processor_time() - start > effort.seconds;
    if (step > 0 && late) break;
    if (late && step > -effort.warm_steps) step = std::max(step, 0);
    const StepTimes before = stepper.times();
    if (step <= 0) {
      before_all = stepper.counts();
      analyses_before = before.analyses;
    }
    const Clock::time_point step_start = Clock::now();
    const double processor_start = processor_time();
    if (!stepper.step()) {
      row.status = stepper.stop_reason();
      std::ranges::replace(row.status, ',', ';');
      break;
    }
    const double processor = processor_time() - processor_start, by_the_clock = since(step_start);
    if (step >= 0)
      samples.add(what.threads == 1 ? processor : by_the_clock, by_the_clock, before, stepper.times());
  }
  samples.write(row);
  row.heap_steps = heap() - heap_built;
  row.factor_memory = 1e-6 * stepper.factor_memory();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  row.peak = static_cast<double>(usage.ru_maxrss) * 1024e-6;
  const StepCounts& counts = stepper.counts();
  const auto each = [&](long StepCounts::*count) {
    return row.steps > 0 ? static_cast<double>(counts.*count - before_all.*count) / row.steps : 0;
  };
  row.substeps = each(&StepCounts::substeps);
  row.rejected = each(&StepCounts::rejected);
  row.iterations = each(&StepCounts::contact_iterations);
  row.linear_solves = each(&StepCounts::linear_solves);
  row.factorizations = each(&StepCounts::factorizations);
  if (row.steps > 0)
    row.analyses = static_cast<double>(stepper.times().analyses - analyses_before) / row.steps;
  row.contacts = static_cast<double>(counts.contacts);
  row.largest_speed =
      stepper.state().velocity.size() > 0 ? stepper.state().velocity.cwiseAbs().maxCoeff() : 0;
  if (effort.cholmod) add_factor_times(stepper, effort.factor_mb, row);
  return row;
}

}  // namespace step_performance
