#include <ddacontact/block/corotational_shape.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

using namespace support;

namespace {

Scene explicit_scene(double time_step, int steps) {
  Scene scene;
  scene.analysis.scheme = Scheme::central_difference;
  scene.analysis.time_step = time_step;
  scene.analysis.steps = steps;
  scene.analysis.gravity = Vec2(0, -10);
  scene.materials = {{"rock", 2500, 1e9, 0.2}};
  scene.joints = {{"joint", 30, 0, 0, std::nullopt}};
  scene.contact.normal_stiffness = 4e10;
  scene.contact.tangential_stiffness = 1.6e10;
  return scene;
}

/// Kinetic and elastic energy of a wall of 60 bricks of 10 GPa, every .1 ms for 10 ms of sudden gravity.
std::vector<double> energies_of_wall(Scheme scheme, double time_step) {
  Scene scene = explicit_scene(time_step, static_cast<int>(std::lround(1e-2 / time_step)));
  scene.analysis.scheme = scheme;
  scene.materials = {{"rock", 2500, 1e10, 0.2}};
  scene.contact.normal_stiffness = 4e11;
  scene.contact.tangential_stiffness = 1.6e11;
  scene.blocks = {block(rectangle(-1, -1, 8, 1), true)};
  for (int row = 0; row < 12; ++row)
    for (int column = 0; column < 5; ++column)
      scene.blocks.push_back(block(rectangle(column + 0.5 * (row % 2), 0.5 * row, 1, 0.5)));
  const BuiltScene built = build(scene);
  std::vector<double> energies;
  for (int k = 0; k < 100; ++k) {
    run(*built.stepper, scene.analysis.steps / 100);
    energies.push_back(built.stepper->energy().now.kinetic + built.stepper->energy().now.elastic);
  }
  return energies;
}

/// The largest difference over the peak.
double difference(const std::vector<double>& energies, const std::vector<double>& exact) {
  double largest = 0;
  for (std::size_t k = 0; k < exact.size(); ++k)
    largest = std::max(largest, std::abs(energies[k] - exact[k]));
  return largest / *std::max_element(exact.begin(), exact.end());
}

}  // namespace

/// Against steps ten times as short; the default damps what is shorter than a step.
TEST(Explicit, AWallKeepsItsEnergy) {
  const std::vector<double> exact = energies_of_wall(Scheme::central_difference, 1e-5);
  const double kept = difference(energies_of_wall(Scheme::central_difference, 1e-4), exact),
               damped = difference(energies_of_wall(Scheme::decaying, 1e-4), exact);
  EXPECT_LE(kept, 1.5e-2);
  EXPECT_GE(damped, 5 * kept);
}

/// A plate of a hundredth of the others' height does not make their steps shorter.
TEST(Explicit, SliversDecay) {
  Scene scene = explicit_scene(1e-3, 400);
  scene.analysis.damping.mass = 50;
  scene.blocks = {block(rectangle(-1, -1, 42, 1), true), block(rectangle(0, 1, 1, 0.01))};
  for (int k = 0; k < 20; ++k) scene.blocks.push_back(block(rectangle(2 * k, 0, 1, 1)));
  const BuiltScene built = run(scene);
  const StableStep stable = *built.stepper->stable_step();
  EXPECT_NE(stable.block, 1);
  EXPECT_EQ(stable.n_decaying, 1);
  EXPECT_EQ(built.stepper->notes().size(), 1u);
  EXPECT_LT(critical_step(*built.stepper->blocks().block(1).shape(), scene.analysis.damping),
            0.1 * stable.dt);
  EXPECT_LE(travel(*built.stepper, 1).norm(), 1e-4);
  EXPECT_LE(built.stepper->equilibrium().fastest, 1e-4);
  double weight = 0;
  for (const ContactRecord& contact : built.stepper->contacts())
    if (contact.pair.edge_block == 0 || contact.pair.vertex_block == 0) weight += contact.normal;
  EXPECT_NEAR(weight, 20.01 * 2500 * 10, 1e-2 * 20 * 2500 * 10);
}

/// Dynamic steps solve contacts to 1e-3, static ones to 1e-8, and both to what is requested.
TEST(Explicit, ContactsAreSolvedToTheToleranceOfTheScheme) {
  Scene scene = explicit_scene(1e-3, 3);
  scene.blocks = {block(rectangle(-1, -1, 3, 1), true), block(rectangle(0, 0, 1, 1))};
  EXPECT_EQ(run(scene).stepper->counts().largest_tolerance, 1e-3);
  Scene at_rest = scene;
  at_rest.analysis.mode = Mode::statics;
  EXPECT_EQ(run(at_rest).stepper->counts().largest_tolerance, 1e-8);
  scene.contact.tolerance = 1e-6;
  EXPECT_EQ(run(scene).stepper->counts().largest_tolerance, 1e-6);
}

/// Without damping its own vibrations lift it now and then: it squeals.
TEST(Explicit, ABlockSlidesAsCoulombSays) {
  Scene scene = explicit_scene(1e-3, 300);
  scene.analysis.damping.stiffness = 3e-4;
  const double slope = radians(40);
  scene.blocks = {block(turned(rectangle(-1, -1, 12, 1), -slope), true),
                  block(turned(rectangle(0, 0, 1, 0.5), -slope))};
  const BuiltScene built = run(scene);
  const double t = 0.3, a = 10 * (std::sin(slope) - std::tan(radians(30)) * std::cos(slope));
  EXPECT_NEAR(travel(*built.stepper, 1).norm(), a * t * t / 2, 3e-3 * a * t * t / 2);
  EXPECT_LE(built.stepper->counts().max_penetration, 1e-5);
}

/// Two blocks meet askew, with friction: no force but theirs.
TEST(Explicit, CollisionsKeepMomenta) {
  Scene scene = explicit_scene(1e-3, 100);
  scene.analysis.gravity.setZero();
  scene.blocks = {block(rectangle(0, 0, 1, 1)), block(turned(rectangle(1.2, 0.3, 1, 0.7), 0.1))};
  scene.blocks[0].velocity = {2, 0.5};
  const BuiltScene built = build(scene);
  const double mass = built.stepper->blocks().block(0).mass_total();
  run(*built.stepper, scene.analysis.steps);
  EXPECT_GT(momentum(*built.stepper, 1).norm(), 0.1 * mass);
  EXPECT_LE((momentum(*built.stepper, 0) + momentum(*built.stepper, 1) - mass * Vec2(2, 0.5)).norm(),
            1e-11 * mass);
  EXPECT_LE(built.stepper->energy().now.kinetic + built.stepper->energy().now.elastic,
            mass * Vec2(2, 0.5).squaredNorm() / 2);
  EXPECT_EQ(built.stepper->energy().created(), 0);
}

/// A column that static steps have brought to rest to round-off, awake for a second. What contacts are solved
/// to, 1e-3 of their forces, is far above what is left: it must not grow.
TEST(Explicit, AnEquilibriumStaysAtRest) {
  Scene scene = explicit_scene(5e-4, 2000);
  scene.analysis.damping.mass = 5;
  scene.analysis.skip.sleep = false;
  scene.materials = {{"rock", 2500, 1e10, 0.2}};
  scene.blocks = {block(rectangle(-1, -1, 3, 1), true)};
  for (int k = 0; k < 10; ++k) scene.blocks.push_back(block(rectangle(0, k, 1, 1)));
  for (BlockDescription& b : scene.blocks) b.model = BlockModel::affine;
  StageDescription settling = scene.stage("settle"), awake = scene.stage("awake");
  settling.analysis.mode = Mode::statics;
  settling.analysis.time_step = 0.05;
  settling.analysis.steps = 30;
  scene.stages = {settling, awake};
  const BuiltScene built = build(scene);
  run(*built.stepper, 2030);
  EXPECT_LE(built.stepper->equilibrium().fastest, 1e-7);
  EXPECT_TRUE(built.stepper->is_at_rest());
}

/// Nothing but its fall gives a block on the floor energy, however its contacts correct their gaps.
TEST(ConservingSchemes, GainNothingUnderSuddenGravity) {
  for (const Scheme scheme : {Scheme::central_difference, Scheme::midpoint})
    for (const double time_step : {1e-3, 2e-4}) {
      Scene scene = explicit_scene(time_step, static_cast<int>(std::lround(0.5 / time_step)));
      scene.analysis.scheme = scheme;
      scene.materials = {{"rock", 2500, 1e10, 0.2}};
      scene.blocks = {block(rectangle(-1, -1, 12, 1), true), block(rectangle(0, 0, 10, 10))};
      const BuiltScene built = build(scene);
      const EnergyLedger& ledger = built.stepper->energy();
      double largest = 0, exchanged = 0;
      for (int k = 0; k < scene.analysis.steps; ++k) {
        run(*built.stepper, 1);
        largest = std::max(largest, ledger.now.kinetic + ledger.now.elastic + ledger.now.gravity);
        exchanged = std::max(exchanged, std::abs(ledger.now.gravity));
      }
      EXPECT_GT(exchanged, 100);
      EXPECT_LE(largest, 1e-2 * exchanged)
          << "scheme " << static_cast<int>(scheme) << ", " << time_step << " s";
    }
}

/// A force that rises and falls ten times between none and 50 MPa, far beyond what the tolerance allows the
/// springs: forces are raised and lowered at the same gaps.
TEST(ConservingSchemes, GainNothingFromCyclesOfPressing) {
  constexpr int steps = 200, steps_a_cycle = 20;
  Scene scene = explicit_scene(1e-2, steps);
  scene.analysis.scheme = Scheme::midpoint;
  scene.materials = {{"rock", 2500, 3.5e10, 0.2}};
  scene.contact.normal_stiffness = 1.4e12;
  scene.contact.tangential_stiffness = 5.6e11;
  scene.blocks = {block(rectangle(-1, -1, 4, 1), true), block(rectangle(0, 0, 2, 1))};
  TimeFunction pressing{TimeFunction::Kind::history};
  for (int k = 0; k <= steps; ++k)
    pressing.history.emplace_back(k * 1e-2, 0,
                                  -2.5e7 * (1 - std::cos(2 * std::numbers::pi * k / steps_a_cycle)));
  scene.loads = {body_load(1, pressing)};
  const BuiltScene built = build(scene);
  const EnergyLedger& ledger = built.stepper->energy();
  double gained = 0, exchanged = 0;
  for (int k = 0; k < steps; ++k) {
    run(*built.stepper, 1);
    gained =
        std::max(gained, ledger.now.kinetic + ledger.now.elastic + ledger.now.gravity - ledger.now.external);
    exchanged = std::max(exchanged, ledger.now.elastic);
  }
  EXPECT_GT(exchanged, 1e4);
  EXPECT_LE(gained, 5e-3 * exchanged);
}

/// A soft block on the floor vibrates as its first fall leaves it vibrating.
TEST(ConservingSchemes, SoftBlocksVibrateNoMoreThanAtFirst) {
  for (const Scheme scheme : {Scheme::central_difference, Scheme::midpoint}) {
    Scene scene = explicit_scene(1e-3, 10000);
    scene.analysis.scheme = scheme;
    scene.materials = {{"soft", 2500, 1e7, 0.2}};
    scene.contact.normal_stiffness = 4e8;
    scene.contact.tangential_stiffness = 1.6e8;
    scene.blocks = {block(rectangle(-1, -1, 4, 1), true), block(rectangle(0, 0, 2, 1))};
    const BuiltScene built = build(scene);
    const auto peak = [&](int n) {
      double largest = 0;
      for (int k = 0; k < n; ++k) {
        run(*built.stepper, 1);
        largest = std::max(largest, built.stepper->energy().now.kinetic);
      }
      return largest;
    };
    const double first = peak(1000);
    EXPECT_GT(first, 1);
    EXPECT_LE(peak(9000), 1.02 * first) << "scheme " << static_cast<int>(scheme);
  }
}
