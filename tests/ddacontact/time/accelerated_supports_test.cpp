// Supports that move: what they drive, pin and hit feels their motion as it is, in every scheme.
#include <tests/ddacontact/simple_scenes.hpp>

#include <ddacontact/block/rigid_velocity.hpp>

#include <array>

using namespace support;

namespace {

using Kind = TimeFunction::Kind;

constexpr double density = 2000, g = 10;

Scene driven_scene(Scheme scheme, double time_step, int steps) {
  Scene scene;
  scene.analysis.scheme = scheme;
  scene.analysis.kinematics = Kinematics::corotational;
  scene.analysis.time_step = time_step;
  scene.analysis.steps = steps;
  scene.analysis.gravity = {0, -g};
  scene.materials = {{"rock", density, 1e10, 0.2}};
  scene.joints = {{"joint", 0, 0, 0, std::nullopt}};
  scene.contact.normal_stiffness = 4e11;
  scene.contact.tangential_stiffness = 1.6e11;
  return scene;
}

Support moved(int of, const std::vector<int>& vertices, Kind kind, const Vec2& rate) {
  return {of, vertices, true, true,
          history_function(kind, {{0, rate.x(), rate.y()}, {9, rate.x(), rate.y()}})};
}

constexpr std::array all_schemes{Scheme::decaying, Scheme::midpoint, Scheme::dda, Scheme::newmark,
                                 Scheme::backward_euler};

}  // namespace

/// F = m (a - g), and the work of the supports is that of F along their way.
TEST(AcceleratedSupports, BearTheInertiaOfWhatTheyDriveOnce) {
  const Vec2 a(2, -1), exact = 2 * density * (a + Vec2(0, g));
  for (const Scheme scheme : all_schemes)
    for (const BlockModel model : {BlockModel::wachspress, BlockModel::affine}) {
      Scene scene = driven_scene(scheme, 0.01, 40);
      scene.blocks = {block(rectangle(0, 0, 2, 1))};
      scene.blocks[0].model = model;
      scene.supports = {moved(0, {0, 1, 2, 3}, Kind::acceleration_history, a)};
      const BuiltScene built = run(scene);
      const Vec2 reaction = built.stepper->reactions().rowwise().sum();
      EXPECT_LE((reaction - exact).norm(), 1e-6 * exact.norm()) << static_cast<int>(scheme);
      EXPECT_NEAR(built.stepper->energy().now.external, exact.dot(a) * 0.08, 1e-2 * exact.norm() * 0.16);
    }
}

/// A block swings about a pivot that accelerates upwards as it does about one at rest under gravity.
TEST(AcceleratedSupports, APivotThatAcceleratesIsAPivotUnderGravity) {
  for (const Scheme scheme : all_schemes)
    for (const BlockModel model : {BlockModel::wachspress, BlockModel::affine}) {
      const auto rotation = [&](bool accelerates) {
        Scene scene = driven_scene(scheme, 0.002, 200);
        scene.blocks = {block(rectangle(0, 0, 2, 1))};
        scene.blocks[0].model = model;
        if (accelerates) scene.analysis.gravity.setZero();
        scene.supports = {moved(0, {0}, Kind::acceleration_history, {0, accelerates ? g : 0})};
        return run(scene).stepper->state().rotation[0];
      };
      const double at_rest = rotation(false);
      EXPECT_LT(at_rest, -0.4);
      EXPECT_NEAR(rotation(true), at_rest, scheme == Scheme::backward_euler ? 5e-3 : 1e-3)
          << static_cast<int>(scheme);
    }
}

/// Shi's open-close iteration holds a pin where it is while the block turns: the centrifugal force m w^2 r.
TEST(AcceleratedSupports, APinBearsTheCentrifugalForceInOpenCloseIterations) {
  constexpr double omega = 3;
  const double exact = 2 * density * omega * omega * std::hypot(1, 0.5);
  for (const BlockModel model : {BlockModel::wachspress, BlockModel::affine}) {
    Scene scene = driven_scene(Scheme::decaying, 0.001, 300);
    scene.contact.method = ContactMethod::classic;
    scene.contact.penetration_tolerance = 0;
    scene.analysis.gravity.setZero();
    scene.blocks = {block(rectangle(0, 0, 2, 1))};
    scene.blocks[0].model = model;
    scene.blocks[0].fixed_vertices = {0};
    scene.blocks[0].velocity = omega * Vec2(-0.5, 1);
    scene.blocks[0].angular_velocity = omega;
    const BuiltScene built = run(scene);
    EXPECT_NEAR(built.stepper->reactions().rowwise().sum().norm(), exact, 5e-3 * exact);
    EXPECT_NEAR(built.stepper->state().rotation[0], 0.3 * omega, 1e-3);
  }
}

/// A block falls on a plate that supports move up, held everywhere or at two vertices: the plate is as heavy
/// as a wall, and what its supports do is in the ledger.
TEST(AcceleratedSupports, ThrowWhatTheyHitByItsRestitution) {
  constexpr double up = 2, height = 0.5, restitution = 0.5, end = 0.5;
  const double meeting = (-up + std::sqrt(up * up + 2 * g * height)) / g,
               thrown = up + restitution * (up + g * meeting), exact = thrown - g * (end - meeting);
  for (const Scheme scheme : {Scheme::decaying, Scheme::midpoint, Scheme::dda, Scheme::backward_euler})
    for (const BlockModel model : {BlockModel::wachspress, BlockModel::mesh, BlockModel::affine})
      for (const bool wholly : {true, false}) {
        // Others bend, or do not allow it; of schemes without damping the jump to `up` lets the plate ring.
        if (!wholly && (model != BlockModel::wachspress || scheme != Scheme::decaying)) continue;
        Scene scene = driven_scene(scheme, 0.005, 100);
        scene.joints[0].restitution = restitution;
        scene.blocks = {block(rectangle(-1, -0.5, 4, 0.5)), block(rectangle(0.5, height, 1, 1))};
        scene.blocks[0].model = model;
        scene.blocks[1].model = BlockModel::affine;
        scene.supports = {
            moved(0, wholly ? std::vector{0, 1, 2, 3} : std::vector{0, 1}, Kind::velocity_history, {0, up})};
        const BuiltScene built = run(scene);
        SCOPED_TRACE(static_cast<int>(scheme));
        const double velocity = rigid_velocity(built.stepper->blocks().block(1), built.stepper->state(),
                                               built.stepper->state().velocity)
                                    .linear.y();
        EXPECT_NEAR(velocity, exact, scheme == Scheme::backward_euler ? 0.03 : 2e-3);
        EXPECT_EQ(built.stepper->counts().limited_impacts, 0);
        if (scheme == Scheme::decaying) {
          EXPECT_LE(built.stepper->energy().created(), 1e-5);
        }
      }
}

/// Supports squeeze a block, which a second one hits from above: it goes where momentum leads it, by the
/// restitution asked for, and the supports' work is what the squeezed block stores.
TEST(AcceleratedSupports, ABlockThatTheySqueezeIsHitLikeAFreeOne) {
  constexpr double jaws = 5e-4, restitution = 0.5, ratio = 0.6 * 0.6;
  for (const Scheme scheme : {Scheme::decaying, Scheme::midpoint, Scheme::dda}) {
    Scene scene = driven_scene(scheme, 0.001, 20);
    scene.analysis.gravity.setZero();
    scene.analysis.block_model = BlockModel::affine;
    scene.joints[0].restitution = restitution;
    scene.blocks = {block(rectangle(-1.5, 0, 1, 1)), block(rectangle(0.5, 0, 1, 1)),
                    block(rectangle(-0.5, 0, 1, 1)), block(rectangle(-0.3, 1.0095, 0.6, 0.6))};
    scene.blocks[3].velocity = {0, -1};
    for (const int of : {0, 1})
      scene.supports.push_back(moved(of, {0, 1, 2, 3}, Kind::velocity_history, {of == 0 ? jaws : -jaws, 0}));
    const BuiltScene built = run(scene);
    SCOPED_TRACE(static_cast<int>(scheme));
    const auto velocity = [&](int b) {
      return rigid_velocity(built.stepper->blocks().block(b), built.stepper->state(),
                            built.stepper->state().velocity)
          .linear.y();
    };
    EXPECT_NEAR(velocity(3), -1 + (1 + restitution) / (1 + ratio), 1e-3);
    EXPECT_NEAR(velocity(2), -(1 + restitution) * ratio / (1 + ratio), 1e-3);
    const Energy& energy = built.stepper->energy().now;
    EXPECT_NEAR(energy.external, energy.elastic, 0.2 * energy.elastic);
  }
}

/// A driven hammer strikes a block just above the joint that bonds it to the floor: the bond breaks, and does
/// not turn the block about itself.
TEST(AcceleratedSupports, ABondBearsNoMoreThanItsStrengthInAnImpact) {
  Scene scene = driven_scene(Scheme::decaying, 0.001, 30);
  scene.analysis.gravity.setZero();
  scene.analysis.block_model = BlockModel::affine;
  scene.joints[0].restitution = 0.5;
  scene.joints[0].cohesion = scene.joints[0].tensile_strength = 20e6;
  scene.blocks = {block(rectangle(-6, -1, 14, 1), true), block(rectangle(-1.5, 0.01, 1, 0.99)),
                  block(rectangle(-0.4905, 0, 0.9905, 1))};
  scene.supports = {moved(1, {0, 1, 2, 3}, Kind::velocity_history, {1, 0})};
  const BuiltScene built = run(scene);
  const RigidVelocity struck = rigid_velocity(built.stepper->blocks().block(2), built.stepper->state(),
                                              built.stepper->state().velocity);
  EXPECT_GT(built.stepper->counts().broken_bonds, 0);
  EXPECT_LE(struck.linear.norm(), 3);
  EXPECT_LE(std::abs(struck.angular), 1);
}
