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

/// Whether sweeps over the contacts solve steps in which inertia dominates.
BuiltScene built_with(bool sweeps, Scene scene) {
  scene.analysis.skip.cg = sweeps;
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
/// differences of round-off from step to step, whatever they come from. Returns how many sweeps there were.
long compare_steps(const Scene& scene, int steps, const std::string& name) {
  const BuiltScene with = built_with(true, scene), without = built_with(false, scene);
  long count = 0;
  for (int k = 0; k < steps; ++k) {
    with.stepper->restore(without.stepper->run_record());
    const bool made = with.stepper->step();
    EXPECT_EQ(without.stepper->step(), made) << name << ", step " << k;
    if (!made) return count;
    expect_same_motion(*with.stepper, *without.stepper, scene.analysis, 1,
                       name + ", step " + std::to_string(k));
    EXPECT_EQ(without.stepper->counts().sweeps, 0);
    count += with.stepper->counts().sweeps;
  }
  return count;
}

long compare_runs(const Scene& scene, const std::string& name) {
  const BuiltScene with = built_with(true, scene), without = built_with(false, scene);
  support::run(*with.stepper, scene.analysis.steps);
  support::run(*without.stepper, scene.analysis.steps);
  expect_same_motion(*with.stepper, *without.stepper, scene.analysis, scene.analysis.steps, name);
  EXPECT_EQ(without.stepper->counts().impacts, 0) << name;
  EXPECT_LE(with.stepper->counts().max_residual, residual_tolerance) << name;
  EXPECT_EQ(without.stepper->counts().sweeps, 0) << name;
  return with.stepper->counts().sweeps;
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

/// Inertia dominates where no wave crosses a block within a step.
constexpr double time_step = 1e-5;

/// With friction that wedges no blocks: those may have several solutions, of which other ways of solving find
/// others.
long steps_of(Scene scene, const std::string& name) {
  scene.analysis.time_step = std::min(scene.analysis.time_step, time_step);
  for (auto& joint : scene.joints) joint.friction_angle = std::min(joint.friction_angle, 30.);
  return compare_steps(scene, 10, name);
}

}  // namespace

TEST(SkipWithinTolerance, StepsOfMadeScenes) {
  long solutions = 0;
  for (const auto& [name, scene] : support::made_scenes()) solutions += steps_of(scene, name);
  EXPECT_GT(solutions, 0);
}

TEST(SkipWithinTolerance, StepsOfRandomScenes) {
  long solutions = 0;
  for (std::uint64_t seed = 1000; seed < 1000 + 3 * support::n_drop_kinds; ++seed)
    solutions += steps_of(support::random_drop(seed), "seed " + std::to_string(seed));
  EXPECT_GT(solutions, 0);
}

TEST(SkipWithinTolerance, ARunOfSlidingBlocks) {
  EXPECT_GT(compare_runs(sliding(time_step, 40), "sliding"), 0);
}

TEST(SkipWithinTolerance, ARunOfAWall) {
  EXPECT_GT(compare_runs(wall(time_step, 20), "wall"), 0);
}
