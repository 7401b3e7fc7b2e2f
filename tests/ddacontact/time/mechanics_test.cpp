/// \file Blocks in motion and collision. What they do on slopes, in stacks and in flight is checked by the
/// verification pages (doc/verification/slope.cpp, resting.cpp, toppling.cpp, tumbling.cpp), over more steps,
/// angles and ratios.
#include <tests/ddacontact/simple_scenes.hpp>

using namespace support;

namespace {

constexpr double g = 9.8, one_turn = 2 * std::numbers::pi;

/// Rock (2500 kg/m3, 35 GPa, 0.3) with the default mechanics.
Scene stiff_scene(double time_step, double end_time, Scheme scheme = Scheme::decaying) {
  Scene scene;
  scene.analysis.time_step = time_step;
  scene.analysis.steps = static_cast<int>(std::lround(end_time / time_step));
  scene.analysis.gravity = Vec2(0, -g);
  scene.analysis.kinematics = Kinematics::corotational;
  scene.analysis.scheme = scheme;
  scene.analysis.cutting_factor = 0.5;
  scene.analysis.max_displacement_ratio = 10;
  scene.contact = {ContactMethod::staged, 40 * 35e9, 16 * 35e9, 1e-6};
  scene.materials = {{"rock", 2500, 35e9, 0.3}};
  scene.joints.resize(1);
  return scene;
}

RigidVelocity rigid(const Stepper& stepper, int b) {
  return rigid_velocity(stepper.blocks().block(b), stepper.state(), stepper.state().velocity);
}

double spin_momentum(const Stepper& stepper, int b) {
  const Block& of = stepper.blocks().block(b);
  const VectorXd turning = of.rotation(stepper.state());
  return turning.dot(of.mass() * turning) * rigid(stepper, b).angular;
}

double mechanical_energy(const Stepper& stepper) {
  const Energy& now = stepper.energy().now;
  return now.kinetic + now.elastic + now.gravity;
}

}  // namespace

/// A rigid motion about the vertex: the reaction does no work, whatever the step.
TEST(FixedVertex, ABlockThatTurnsAboutItKeepsItsEnergyAndItsPeriod) {
  for (const BlockModel model : {BlockModel::affine, BlockModel::mean_value})
    for (const Scheme scheme : {Scheme::decaying, Scheme::central_difference, Scheme::midpoint})
      for (const double time_step : {0.02, 0.005}) {
        SCOPED_TRACE(time_step);
        Scene scene = stiff_scene(time_step, 0.2, scheme);
        scene.analysis.gravity.setZero();
        scene.blocks = {block(rectangle(0, 0, 1, 1))};
        scene.blocks[0].model = model;
        scene.blocks[0].angular_velocity = one_turn;
        scene.blocks[0].velocity = {-one_turn / 2, one_turn / 2};
        scene.supports = {{0, {0}, true, true, {}}};
        const BuiltScene built = build(scene);
        const double before = mechanical_energy(*built.stepper);
        run(*built.stepper, scene.analysis.steps);
        EXPECT_NEAR(mechanical_energy(*built.stepper) / before, 1, 1e-5);
        EXPECT_NEAR(built.stepper->energy().balance_error(), 0, 1e-6 * before);
        const Points& x = built.stepper->state().position;
        const double second_order = std::pow(one_turn * time_step, 2) / 6;
        EXPECT_NEAR(std::atan2(x(1, 1) - x(1, 0), x(0, 1) - x(0, 0)), 0.2 * one_turn,
                    0.2 * one_turn * second_order);
      }
}

TEST(ShakenBase, CarriesABlockWithTheForcesOfItsAcceleration) {
  for (const Vec2& direction : {Vec2(1, 0), Vec2(0, 1)}) {
    Scene scene = stiff_scene(0.005, 1);
    scene.joints[0].friction_angle = 25;  // bears 0.47 g
    scene.blocks = {block(rectangle(-3, -1, 8, 1)), block(rectangle(0, 0, 2, 1))};
    Support base;
    base.vertices = {0, 1, 2, 3};
    base.displacement.kind = TimeFunction::Kind::history;
    for (int k = 0; k <= 1000; ++k) {
      const double t = k * 1e-3,
                   way = 0.3 * g / (one_turn * one_turn) * (one_turn * t - std::sin(one_turn * t));
      base.displacement.history.emplace_back(t, way * direction.x(), way * direction.y());
    }
    scene.supports = {base};
    const BuiltScene built = build(scene);
    Stepper& stepper = *built.stepper;
    for (int k = 1; k <= scene.analysis.steps; ++k) {
      ASSERT_TRUE(stepper.step()) << stepper.stop_reason();
      if (k < 20) continue;  // gravity acts suddenly
      Vec2 force(0, 0);
      for (const ContactRecord& contact : stepper.contacts()) {
        const double along = contact.pair.vertex_block == 1 ? contact.shear : -contact.shear;
        force += Vec2(-along, contact.normal);
      }
      const double at_start = (k - 1) * scene.analysis.time_step;  // what the rates of both sides of it say
      const Vec2 expected = Vec2(0, g) + 0.3 * g * std::sin(one_turn * at_start) * direction;
      EXPECT_LT((force / stepper.blocks().block(1).mass_total() - expected).norm(), 2e-3 * g) << k;
    }
    const Points moved = stepper.blocks().displacements(stepper.state());
    EXPECT_LT((moved.col(4) - moved.col(0)).norm(), 1e-6);
  }
}

TEST(Impact, LeavesTheRestitutionAskedForAtEveryStepAndPhase) {
  for (const Scheme scheme : {Scheme::decaying, Scheme::midpoint})
    for (const double e : {0., 0.25, 0.5, 0.75, 1.})
      for (const double dt : {1e-5, 1e-3, 2e-2})
        for (const double phase : {0.03, 0.4, 0.77, 0.98}) {
          const double hit = (1 + phase) * dt, speed = 2 + g * hit;
          Scene scene = stiff_scene(dt, 4 * dt, scheme);
          scene.joints[0].restitution = e;
          scene.blocks = {block(rectangle(-2, -1, 5, 1), true),
                          block(rectangle(0, 2 * hit + g * hit * hit / 2, 1, 1))};
          scene.blocks[1].velocity = {0, -2};
          const BuiltScene built = run(scene);
          const double since = e == 0 ? 0 : g * (4 * dt - hit);
          EXPECT_NEAR((rigid(*built.stepper, 1).linear.y() + since) / speed, e, 0.02) << dt << ' ' << phase;
        }
}

/// A slender block that rocks on its lower right corner, tilted by so much and falling back to upright.
BuiltScene rocking(double tilt) {
  constexpr double R = 1.1, speed = 0.35;
  const double alpha = radians(8), b = 2 * R * std::sin(alpha), h = 2 * R * std::cos(alpha);
  Scene scene = stiff_scene(0.008, 1);
  scene.joints[0].friction_angle = 60;
  scene.blocks = {block(rectangle(-3, -1, 6, 1), true), block(turned(rectangle(-b, 0, b, h), -tilt))};
  const Vec2 centre = R * Vec2(-std::sin(alpha - tilt), std::cos(alpha - tilt));
  scene.blocks[1].angular_velocity = speed;
  scene.blocks[1].velocity = speed * Vec2(-centre.y(), centre.x());
  return build(scene);
}

TEST(Impact, AtTheVeryEndOfAStepLetsTheOtherCornerGo) {
  constexpr int steps = 3;
  const auto tilt_after = [](double tilt) {
    const BuiltScene built = rocking(tilt);
    run(*built.stepper, steps);
    return tilt - built.stepper->state().rotation[1];
  };
  double upright = 0.01;  // the tilt to start from that ends upright
  for (const double above : {1e-2, 1e-4, 1e-5, 1e-5}) upright += above - tilt_after(upright + above);
  const double left = 1 - 1.5 * std::pow(std::sin(radians(8)), 2);  // Housner, of the angular velocity
  for (const double beyond : {-1e-5, -1e-6, -1e-7, 0., 1e-7, 3e-7, 1e-6, 2e-6, 4e-6, 1e-5, 1e-4}) {
    const BuiltScene built = rocking(upright - beyond);
    Stepper& stepper = *built.stepper;
    run(stepper, steps - 1);
    const double before = rigid(stepper, 1).angular;
    run(stepper, 3);
    EXPECT_GT(rigid(stepper, 1).angular, 0.85 * left * before) << beyond;
    EXPECT_LT(rigid(stepper, 1).angular, left * before) << beyond;
  }
}

TEST(Impact, OfTwoFreeBlocksKeepsMomentaAndMakesNoEnergy) {
  for (const Scheme scheme : {Scheme::decaying, Scheme::midpoint})
    for (const double e : {0., 0.5, 1.})
      for (const double tilt : {0., 0.4})
        for (const double dt : {0.02, 0.002}) {
          Scene scene = stiff_scene(dt, 0.3, scheme);
          scene.analysis.gravity.setZero();
          scene.joints[0].restitution = e;
          scene.joints[0].friction_angle = 30;
          scene.blocks = {block(rectangle(-1, -0.5, 1, 1)), block(turned(rectangle(-1, -0.5, 2, 1), tilt))};
          scene.blocks[1].vertices.colwise() += Vec2(1.3, tilt);
          scene.blocks[0].velocity = {3, 0.2};
          scene.blocks[1].velocity = {-1, 0};
          const BuiltScene built = build(scene);
          Stepper& stepper = *built.stepper;
          const auto angular = [&] {
            double sum = 0;
            for (int b : {0, 1}) {
              const Vec2 x = stepper.blocks().block(b).centroid(stepper.state()), p = momentum(stepper, b);
              sum += x.x() * p.y() - x.y() * p.x() + spin_momentum(stepper, b);
            }
            return sum;
          };
          const double size = momentum(stepper, 0).norm() + momentum(stepper, 1).norm(), L0 = angular(),
                       E0 = mechanical_energy(stepper), x0 = momentum(stepper, 0).x();
          const Vec2 p0 = momentum(stepper, 0) + momentum(stepper, 1);
          for (int k = 0; k < scene.analysis.steps; ++k) {
            run(stepper, 1);
            ASSERT_LE((momentum(stepper, 0) + momentum(stepper, 1) - p0).norm(), 1e-12 * size);
            ASSERT_NEAR(angular(), L0, 1e-6 * size);
            ASSERT_LE(mechanical_energy(stepper), E0 * (1 + 1e-9));
          }
          EXPECT_LT(momentum(stepper, 0).x(), 0.7 * x0);
        }
}

/// So are they from the step on in which a load comes in, whatever gamma.
TEST(Newmark, FollowsALoadThatComesInFromItsFirstStepOn) {
  for (const double gamma : {0.5, 0.7}) {
    Scene scene = stiff_scene(0.01, 0.5, Scheme::newmark);
    scene.analysis.gamma = gamma;
    scene.analysis.beta = (gamma + 0.5) * (gamma + 0.5) / 4;
    scene.blocks = {block(rectangle(0, 0, 1, 1))};
    scene.loads = {body_load(0, constant({5000, 0}))};
    scene.stages = {scene.stage("falling"), scene.stage("pushed")};
    scene.stages[0].analysis.steps = 5;
    scene.stages[1].loads = {0};
    const BuiltScene built = run(scene);
    const double t = 0.5, a = 5000 / scene.materials[0].density;
    EXPECT_NEAR(rigid(*built.stepper, 0).linear.x(), a * t, 1e-9 * a);
    EXPECT_NEAR(travel(*built.stepper, 0).x(), a * t * t / 2, 1e-9 * a);
    EXPECT_NEAR(rigid(*built.stepper, 0).linear.y(), -g * (t + 0.05), 1e-9 * g);
  }
}
