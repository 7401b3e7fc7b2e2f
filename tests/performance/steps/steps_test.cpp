#include <tests/performance/scenes.hpp>
#include <tests/performance/steps/case.hpp>
#include <tests/performance/steps/factor_times.hpp>
#include <tests/performance/steps/growth.hpp>
#include <tests/performance/steps/in_child.hpp>
#include <tests/performance/steps/pictures.hpp>
#include <tests/performance/steps/results.hpp>
#include <tests/performance/steps/step_matrix.hpp>

#include <gtest/gtest.h>
#include <unistd.h>
#include <ddacontact/scene/builder.hpp>
#include <polyfem/core/error.hpp>
#include <polyfem/geometry/validity.hpp>

#include <array>
#include <cmath>
#include <fstream>
#include <set>
#include <string>

namespace step_performance {
namespace {

using namespace ddacontact;

TEST(Scenes, HaveAboutAsManyBlocksAsAskedFor) {
  for (const performance::SceneKind& kind : performance::scene_kinds())
    for (const int n : {100, 1000}) {
      const Scene scene = kind.make(n);
      long movable = 0;
      for (const BlockDescription& block : scene.blocks) movable += !block.fixed;
      EXPECT_NEAR(static_cast<double>(movable), n, 0.2 * n) << kind.name;
    }
}

TEST(Scenes, ConsistOfSoundBlocksThatStep) {
  for (const performance::SceneKind& kind : performance::scene_kinds()) {
    const Scene scene = kind.make(30);
    for (const BlockDescription& block : scene.blocks) {
      EXPECT_FALSE(polyfem::find_defect(block.vertices)) << kind.name;
      EXPECT_FALSE(polyfem::find_non_convex_corner(block.vertices)) << kind.name;
    }
    const BuiltScene built = build(scene);
    EXPECT_TRUE(built.stepper->step()) << kind.name << ": " << built.stepper->stop_reason();
    const bool falls = std::set<std::string>{"rain", "loose_heap", "bin"}.contains(kind.name);
    EXPECT_EQ(built.stepper->counts().contacts == 0, falls) << kind.name;
  }
}

TEST(Scenes, RestWhenSettled) {
  Scene scene = performance::brick_wall(30);
  performance::settle_first(scene);
  const BuiltScene built = build(scene);
  for (int k = 0; k < 5; ++k) ASSERT_TRUE(built.stepper->step());
  EXPECT_LT(built.stepper->state().velocity.cwiseAbs().maxCoeff(), 1e-4);
}

TEST(Measurements, AreReadAsWritten) {
  Measurement m = measure({.scene = "arch", .size = 12, .settled = true, .without = {"cg", "sleep"}},
                          {.warm_steps = 1, .steps = 3});
  EXPECT_EQ(m.steps, 3);
  EXPECT_EQ(m.blocks, 12);
  EXPECT_EQ(m.unknowns, 96);
  EXPECT_EQ(m.without, "cg sleep");
  EXPECT_GT(m.cholmod(), 0);
  const std::string line = line_of(m);
  EXPECT_EQ(line_of(measurement_of(line)), line);
  EXPECT_THROW(measurement_of(line.substr(0, line.rfind(','))), polyfem::Error);
}

TEST(Measurements, HavePhasesThatSumUpToTheStep) {
  const Measurement m =
      measure({.scene = "wall", .size = 20}, {.warm_steps = 0, .steps = 1, .cholmod = false});
  EXPECT_NEAR(m.detection + m.assembly + m.linear() + m.solver + m.update + m.rest, m.total, 1e-9);
  EXPECT_GT(m.factorizations, 0);
  EXPECT_EQ(m.cholmod(), 0);
}

TEST(Measurements, HaveTheMemoryThatIsTaken) {
  // The solution of the step after the last is kept for it.
  for (const auto& [time_step, most] : {std::pair{1e-2, 7.8}, std::pair{1e-4, 6.0}}) {
    const Measurement m = measure({.scene = "wall", .size = 2000, .time_step = time_step},
                                  {.warm_steps = 0, .steps = 1, .cholmod = false});
    const double all = m.heap_blocks + m.heap_steps - m.factor_memory;
    EXPECT_GT(m.heap_steps, 0);
    EXPECT_LT(1e3 * all / m.blocks, most) << "kB a block";
  }
}

TEST(Measurements, RefuseWhatIsNotKnown) {
  EXPECT_THROW(measure({.scene = "castle"}, {}), polyfem::Error);
  EXPECT_THROW(measure({.without = {"lunch"}}, {}), polyfem::Error);
}

TEST(Measurements, ComeFromSummariesToo) {
  const std::filesystem::path directory =
      std::filesystem::path(testing::TempDir()) / ("steps_test_" + std::to_string(getpid()));
  std::filesystem::create_directories(directory);
  std::ofstream(directory / "summary.json")
      << R"({"status": "completed", "steps_completed": 4, "time": 0.04, "blocks": 7, "factorizations": 8,
             "wall_seconds": {"steps": 4.0, "detection": 0.4, "solver": 2.0, "factorization": 1.2}})";
  const Measurement m = measurement_of_result(directory);
  EXPECT_EQ(m.status, "done");
  EXPECT_EQ(m.blocks, 7);
  EXPECT_DOUBLE_EQ(m.time_step, 0.01);
  EXPECT_DOUBLE_EQ(m.total, 1);
  EXPECT_DOUBLE_EQ(m.factorization, 0.3);
  EXPECT_DOUBLE_EQ(m.solver, 0.2);
  EXPECT_DOUBLE_EQ(m.rest, 0.4);
  EXPECT_DOUBLE_EQ(m.factorizations, 2);
  std::filesystem::remove_all(directory);
}

TEST(Growth, IsThePowerOfAPowerLaw) {
  const std::array x{10., 100., 5000.},
      y{3 * std::pow(10., 1.3), 3 * std::pow(100., 1.3), 3 * std::pow(5000., 1.3)};
  EXPECT_NEAR(growth_exponent(x, y), 1.3, 1e-12);
  EXPECT_TRUE(std::isnan(growth_exponent(std::span(x).first(1), std::span(y).first(1))));
}

TEST(Series, GatherWhatDiffersInSizeAlone) {
  Measurement small, large, other;
  small.scene = large.scene = other.scene = "wall";
  small.total = large.total = other.total = 1;
  small.blocks = 10;
  large.blocks = 100;
  other.without = "cg";
  const auto all = size_series(std::array{large, other, small});
  ASSERT_EQ(all.size(), 2U);
  ASSERT_EQ(all[0].rows.size(), 2U);
  EXPECT_EQ(all[0].rows[0].blocks, 10);
}

/// Blocks that fly have no contacts: a translation meets their inertia alone.
TEST(StepMatrix, HoldsTheMassOfAllBlocks) {
  const Scene scene = performance::rain(20);
  const BuiltScene built = build(scene);
  Stepper& stepper = *built.stepper;
  ASSERT_TRUE(stepper.step());
  const polyfem::SparseMatrix lower = step_matrix(stepper);
  VectorXd translation(lower.rows());
  for (Index k = 0; k < translation.size(); ++k) translation[k] = k % 2 == 0;
  double mass = 0;
  for (int b = 0; b < stepper.blocks().n_blocks(); ++b)
    if (stepper.blocks().is_free(b)) mass += stepper.blocks().block(b).mass_total();
  const double dt = scene.analysis.time_step, inertia = step_rule(scene.analysis, dt, dt).inertia();
  EXPECT_NEAR(translation.dot(lower.selfadjointView<Eigen::Lower>() * translation) * dt * dt / inertia, mass,
              1e-6 * mass);
}

TEST(StepMatrix, HasAFactorByBothOrderings) {
  const BuiltScene built = build(performance::brick_wall(30));
  ASSERT_TRUE(built.stepper->step());
  const polyfem::SparseMatrix lower = step_matrix(*built.stepper);
  for (const Ordering ordering : {Ordering::amd, Ordering::metis}) {
    const FactorTimes times = cholmod_times(lower, ordering, 100);
    EXPECT_GE(times.factor, 8e-6 * static_cast<double>(lower.nonZeros()));
    EXPECT_GT(times.factorization, 0);
    EXPECT_EQ(cholmod_times(lower, ordering, 1e-6).factor, 0) << "it was to be left out";
  }
  const FactorTimes own = own_times(lower);
  EXPECT_GE(own.factor, 8e-6 * static_cast<double>(lower.nonZeros()));
  EXPECT_GT(own.factorization, 0);
}

TEST(Child, ReturnsItsTextItsErrorOrNothing) {
  ChildResult result = run_in_child([] { return std::string(100'000, 'x'); }, 10);
  EXPECT_EQ(result.end, ChildResult::End::done);
  EXPECT_EQ(result.text.size(), 100'000U);
  result = run_in_child([]() -> std::string { throw polyfem::Error("no"); }, 10);
  EXPECT_EQ(result.end, ChildResult::End::failed);
  EXPECT_EQ(result.text, "no");
  result = run_in_child(
      [] {
        for (volatile bool for_ever = true; for_ever;) {
        }
        return std::string();
      },
      1);
  EXPECT_EQ(result.end, ChildResult::End::too_long);
}

}  // namespace
}  // namespace step_performance
