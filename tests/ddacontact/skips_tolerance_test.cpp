// Equations solved by iteration where a factor would be dearer: with and without, motions agree within what
// the residual leaves.
#include <tests/ddacontact/simple_scenes.hpp>
#include <tests/support/made_scenes.hpp>
#include <tests/support/random_scenes.hpp>

#include <polyfem/geometry/area_moments.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace ddacontact;

namespace {

/// Of the forces on a block: what a step may leave unbalanced, besides round-off.
constexpr double residual_tolerance = 1e-8;
constexpr double round_off = 64 * std::numeric_limits<double>::epsilon();
/// Of a block's size, m: a hundredth of what contacts may penetrate.
constexpr double place_tolerance = 1e-8;

using Solutions = long StepCounts::*;

BuiltScene built_with(bool Skips::*skip, bool value, Scene scene) {
  scene.analysis.skip.*skip = value;
  return build(scene);
}

/// What a step may leave unbalanced of the forces of contacts and gravity on each block, N per m.
std::vector<double> tolerated_forces(const Stepper& stepper, const Vec2& gravity) {
  const BlockSystem& blocks = stepper.blocks();
  const auto n = static_cast<std::size_t>(blocks.n_blocks());
  std::vector<double> forces(n), stiffest(n, 0), tolerated(n);
  for (std::size_t b = 0; b < n; ++b)
    forces[b] = blocks.block(static_cast<int>(b)).mass_total() * gravity.norm();
  for (const ContactRecord& contact : stepper.contacts())
    for (const int of_pair : {contact.pair.vertex_block, contact.pair.edge_block}) {
      const auto b = static_cast<std::size_t>(of_pair);
      forces[b] += std::hypot(contact.normal, contact.shear);
      stiffest[b] = std::max(stiffest[b], stepper.contact_properties().normal_stiffness);
    }
  for (std::size_t b = 0; b < n; ++b) {
    const Block& block = blocks.block(static_cast<int>(b));
    const double of_lengths = (block.material().elasticity(0, 0) + stiffest[b]) * block.size();
    tolerated[b] = residual_tolerance * forces[b] + round_off * of_lengths;
  }
  return tolerated;
}

/// What a force at a vertex of a rigid block gives the vertex, over what it gives the centroid: the block
/// turns too.
double reach_of_force(const Block& block) {
  const Points outline = block.reference().leftCols(block.n_vertices());
  const polyfem::AreaMoments moments = polyfem::area_moments(outline);
  const double furthest = (outline.colwise() - moments.centroid).colwise().squaredNorm().maxCoeff();
  return 1 + furthest * moments.area / moments.second.trace();
}

/// Velocities differ by what the tolerated forces give in a step, and by the round-off of places over the
/// step.
void expect_same_motion(const Stepper& one, const Stepper& other, const AnalysisOptions& analysis,
                        int n_steps, const std::string& name) {
  const BlockSystem& blocks = one.blocks();
  const double dt = analysis.time_step;
  const Points apart = blocks.positions(one.state()) - other.blocks().positions(other.state());
  const VectorXd change = one.state().going_on() - other.state().going_on();
  const std::vector<double> tolerated = tolerated_forces(other, analysis.gravity);
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    const Block& block = blocks.block(b);
    const double moved = apart.middleCols(block.points().first, block.n_points()).cwiseAbs().maxCoeff(),
                 faster = change.segment(block.unknowns().first, block.n_unknowns()).cwiseAbs().maxCoeff(),
                 by_forces =
                     reach_of_force(block) * tolerated[static_cast<std::size_t>(b)] / block.mass_total() * dt;
    EXPECT_LE(moved, place_tolerance * block.size()) << name << ", block " << b;
    EXPECT_LE(faster, n_steps * (by_forces + round_off * block.size() / dt)) << name << ", block " << b;
  }
}

/// Each step from the same state, that of a run without: impacts and friction near its limit enlarge
/// differences of round-off from step to step, whatever they come from. Returns how often was solved as the
/// skip does.
long compare_steps(bool Skips::*skip, Solutions solutions, const Scene& scene, int steps,
                   const std::string& name) {
  const BuiltScene with = built_with(skip, true, scene), without = built_with(skip, false, scene);
  long count = 0;
  for (int k = 0; k < steps; ++k) {
    with.stepper->restore(without.stepper->run_record());
    const bool made = with.stepper->step();
    EXPECT_EQ(without.stepper->step(), made) << name << ", step " << k;
    if (!made) return count;
    expect_same_motion(*with.stepper, *without.stepper, scene.analysis, 1,
                       name + ", step " + std::to_string(k));
    EXPECT_EQ(without.stepper->counts().*solutions, 0);
    count += with.stepper->counts().*solutions;
  }
  return count;
}

long compare_runs(bool Skips::*skip, Solutions solutions, const Scene& scene, const std::string& name) {
  const BuiltScene with = built_with(skip, true, scene), without = built_with(skip, false, scene);
  support::run(*with.stepper, scene.analysis.steps);
  support::run(*without.stepper, scene.analysis.steps);
  expect_same_motion(*with.stepper, *without.stepper, scene.analysis, scene.analysis.steps, name);
  EXPECT_EQ(without.stepper->counts().impacts, 0) << name;
  EXPECT_LE(with.stepper->counts().max_residual, residual_tolerance) << name;
  EXPECT_EQ(without.stepper->counts().*solutions, 0) << name;
  return with.stepper->counts().*solutions;
}

/// Default mechanics: a fixed ground, turned.
Scene on_ground(double time_step, int steps, double angle) {
  Scene scene;
  scene.analysis.time_step = time_step;
  scene.analysis.steps = steps;
  scene.materials = {{"rock", 2500, 1e10, 0.2}};
  scene.joints = {{"joint", 20, 0, 0, std::nullopt}};
  scene.contact.normal_stiffness = 4e11;
  scene.contact.tangential_stiffness = 1.6e11;
  scene.blocks = {support::block(support::turned(support::rectangle(-20, -1, 60, 1), angle), true)};
  return scene;
}

Scene sliding(double time_step, int steps) {
  const double angle = support::radians(30);
  Scene scene = on_ground(time_step, steps, -angle);
  scene.blocks.push_back(support::block(support::turned(support::rectangle(0, 0, 2, 1), -angle)));
  scene.blocks.push_back(support::block(support::turned(support::rectangle(0.3, 1, 1, 1), -angle)));
  return scene;
}

Scene wall(double time_step, int steps) {
  Scene scene = on_ground(time_step, steps, 0);
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 5; ++column)
      scene.blocks.push_back(support::block(support::rectangle(column + 0.5 * (row % 2), 0.5 * row, 1, 0.5)));
  return scene;
}

struct Case {
  bool Skips::*skip;
  Solutions solutions;
  double longest_step;  ///< s
  /// Of joints, degrees: blocks that wedge each other at more may have several solutions, of which other ways
  /// of solving find others.
  double largest_friction_angle;
  std::string name;
};

class SkipWithinTolerance : public testing::TestWithParam<Case> {
 protected:
  long steps_of(Scene scene, int steps, const std::string& name) const {
    scene.analysis.time_step = std::min(scene.analysis.time_step, GetParam().longest_step);
    for (auto& joint : scene.joints)
      joint.friction_angle = std::min(joint.friction_angle, GetParam().largest_friction_angle);
    return compare_steps(GetParam().skip, GetParam().solutions, scene, steps, name);
  }
  long run_of(Scene (*make)(double, int), int steps, const std::string& name) const {
    const double time_step = std::min(0.01, GetParam().longest_step);
    return compare_runs(GetParam().skip, GetParam().solutions, make(time_step, steps), name);
  }
};

}  // namespace

TEST_P(SkipWithinTolerance, StepsOfMadeScenes) {
  long solutions = 0;
  for (const auto& [name, scene] : support::made_scenes()) solutions += steps_of(scene, 10, name);
  EXPECT_GT(solutions, 0);
}

TEST_P(SkipWithinTolerance, StepsOfRandomScenes) {
  long solutions = 0;
  for (std::uint64_t seed = 1000; seed < 1000 + 3 * support::n_drop_kinds; ++seed)
    solutions += steps_of(support::random_drop(seed), 10, "seed " + std::to_string(seed));
  EXPECT_GT(solutions, 0);
}

TEST_P(SkipWithinTolerance, ARunOfSlidingBlocks) {
  EXPECT_GT(run_of(sliding, 40, "sliding"), 0);
}

TEST_P(SkipWithinTolerance, ARunOfAWall) {
  EXPECT_GT(run_of(wall, 20, "wall"), 0);
}

/// Inertia dominates where no wave crosses a block within a step.
INSTANTIATE_TEST_SUITE_P(OfTheEquations, SkipWithinTolerance,
                         testing::Values(Case{&Skips::stale_factor, &StepCounts::solutions_with_stale_factor,
                                              1, 90, "StaleFactor"},
                                         Case{&Skips::cg, &StepCounts::sweeps, 1e-5, 30, "Cg"}),
                         [](const auto& of) { return of.param.name; });
