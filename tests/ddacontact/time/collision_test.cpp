#include <ddacontact/detection/separation.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <algorithm>
#include <cmath>

using namespace support;

namespace {

/// Rock without friction and gravity.
Scene smooth_rock(std::optional<double> restitution, double time_step) {
  Scene scene;
  scene.analysis.gravity.setZero();
  scene.analysis.time_step = time_step;
  scene.analysis.max_displacement_ratio = 1;
  scene.materials = {{"rock", 2500, 35e9, 0.3}};
  scene.joints = {{"joint", 0, 0, 0, std::nullopt, restitution, 0}};
  scene.contact.normal_stiffness = 1.4e12;
  scene.contact.tangential_stiffness = 5.6e11;
  return scene;
}

/// A square thrown at a row of squares.
Scene row_of_squares(int n, double gap, double restitution, double time_step) {
  Scene scene = smooth_rock(restitution, time_step);
  scene.analysis.steps = static_cast<int>(std::lround(1 / time_step));
  scene.blocks = {block(rectangle(-1.5, 0, 1, 1))};
  scene.blocks[0].velocity = {5, 0};
  for (int k = 0; k < n; ++k) scene.blocks.push_back(block(rectangle(k * (1 + gap), 0, 1, 1)));
  return scene;
}

}  // namespace

/// A rock flies past the corner of a ledge and misses it, or hits it, by 5 mm.
TEST(FlyBy, ACornerThatMissesAnotherHitsNothing) {
  const double angle = radians(-70), speed = 10;
  const Vec2 way(std::cos(angle), std::sin(angle)), aside(-way.y(), way.x());
  for (const double clearance : {5e-3, -5e-3})
    for (const bool mirrored : {false, true})
      for (const std::optional<double> restitution : {std::optional<double>(), std::optional<double>(0.3)})
        for (const double time_step : {5e-3, 1e-3})
          for (const double phase : {0., 0.2, 0.4, 0.6, 0.8}) {
            Scene scene = smooth_rock(restitution, time_step);
            const Vec2 corner = Vec2(1, 1) + clearance * aside - (0.3 + phase * speed * time_step) * way;
            scene.blocks = {block(rectangle(0, 0, 1, 1), true),
                            block(rectangle(corner.x(), corner.y(), 0.7, 0.7))};
            scene.blocks[1].velocity = speed * way;
            if (mirrored) {
              for (BlockDescription& b : scene.blocks)
                b.vertices = (Vec2(-1, 1).asDiagonal() * b.vertices).rowwise().reverse().eval();
              scene.blocks[1].velocity[0] *= -1;
            }
            const BuiltScene built = build(scene);
            run(*built.stepper, static_cast<int>(std::lround(0.06 / time_step)));
            const Vec2 before = 0.49 * 2500 * scene.blocks[1].velocity;
            const double change = (momentum(*built.stepper, 1) - before).norm() / before.norm();
            SCOPED_TRACE(time_step);
            if (clearance > 0)
              EXPECT_LT(change, 1e-9) << phase;
            else
              EXPECT_GT(change, 0.1) << phase;
          }
}

/// Squares of one height hit each other in a row: those hit bulge by a millionth beyond the next one's
/// corners, and meet it all the same.
TEST(FlyBy, CornersOfFacesOfOneHeightDoNotMissEachOther) {
  constexpr double gap = 0.01, speed = 8;
  for (const double time_step : {0.01, 5e-3})
    for (int phase = 0; phase < 17; ++phase) {
      Scene scene = smooth_rock(std::nullopt, time_step);
      scene.blocks = {block(rectangle(-1 - gap - phase / 17. * speed * time_step, 0, 1, 1)),
                      block(rectangle(0, 0, 1, 1)), block(rectangle(1 + gap, 0, 1, 1))};
      for (BlockDescription& b : scene.blocks) b.model = BlockModel::affine;
      scene.blocks[0].velocity = {speed, 0};
      const BuiltScene built = build(scene);
      run(*built.stepper, static_cast<int>(std::lround(0.2 / time_step)));
      for (int b : {0, 1, 2})
        EXPECT_NEAR(momentum(*built.stepper, b).x(), 2500 * speed / 3, 0.01 * 2500 * speed) << phase;
    }
}

/// Nor do corners at the foot of faces that stand on one floor: a square slides against the toe of a wedge.
TEST(FlyBy, ToesOnOneFloorDoNotPassUnderEachOther) {
  for (const double lean : {40., 90.})
    for (const std::optional<double> restitution : {std::optional<double>(), std::optional<double>(0.)})
      for (const double time_step : {0.01, 5e-3})
        for (int phase = 0; phase < 10; ++phase) {
          Scene scene = smooth_rock(restitution, time_step);
          scene.analysis.gravity = {0, -9.8};
          scene.joints[0].friction_angle = 30;
          Points wedge(2, 3), box = turned(rectangle(0, 0, 0.3, 0.2), radians(lean == 90 ? 0 : 50));
          wedge << 0, 0.8, 0.5, 0, 0, 0.47;
          box.colwise() -=
              Vec2(box.row(0).maxCoeff() + 0.02 + phase * 0.1 * 4.3 * time_step, box.row(1).minCoeff());
          scene.blocks = {block(rectangle(-3, -1, 7, 1), true), block(wedge), block(box)};
          scene.blocks[2].velocity = {4.3, 0};
          const BuiltScene built = build(scene);
          for (double t = 0; t < 0.12; t += time_step) {
            run(*built.stepper, 1);
            const Stepper& now = *built.stepper;
            ASSERT_GT(separation(now.blocks().outline_from(now.state(), 1, 1),
                                 now.blocks().outline_from(now.state(), 2, 1)),
                      -3e-5)
                << lean << ' ' << phase << " at " << t;
          }
        }
}

/// A bar and a stone that spin hit each other by a corner of the bar, while a corner of the stone passes the line
/// of another face of the bar beside it: it was not over that face where it did, and is not pushed back.
TEST(FlyBy, ACornerThatPassesALineBesideItsFaceIsNotPushedBack) {
  for (const double time_step : {2.5e-3, 1.25e-3}) {
    Scene scene = smooth_rock(1, time_step);
    scene.materials = {{"rock", 2500, 20e9, 0.2}};
    Points bar(2, 4), stone(2, 12);
    bar << 0, 0.086, 1.063, 0.977,  //
        0, -0.391, -0.176, 0.215;
    stone << -0.321, -0.118, -0.023, -0.061, -0.222, -0.462, -0.718, -0.921, -1.016, -0.979, -0.818, -0.577,
        -0.342, -0.181, 0.06, 0.316, 0.519, 0.614, 0.576, 0.415, 0.175, -0.081, -0.284, -0.379;
    scene.blocks = {block(bar), block(stone)};
    scene.blocks[0].velocity = {-4.64, -1.53};
    scene.blocks[0].angular_velocity = -12.97;
    scene.blocks[1].velocity = {3.5, -1.54};
    scene.blocks[1].angular_velocity = -7.98;
    const BuiltScene built = build(scene);
    const double before = built.stepper->energy().now.kinetic;
    run(*built.stepper, 8);
    EXPECT_GT(built.stepper->counts().impacts, 0);
    EXPECT_NEAR(built.stepper->energy().now.kinetic, before, 1e-5 * before);
    EXPECT_LE(built.stepper->energy().now.pushed_out, 1e-9 * before);
  }
}

/// Two held blocks are one ground: a corner that falls on their seam rebounds as it does from one block.
TEST(Seam, OfHeldBlocksReturnsACornerAsOneBlockDoes) {
  const auto momentum_after = [](bool seam, std::optional<double> restitution, double beside) {
    Scene scene = smooth_rock(restitution, 5e-3);
    if (seam)
      scene.blocks = {block(rectangle(-3, -1, 3, 1), true), block(rectangle(0, -1, 3, 1), true)};
    else
      scene.blocks = {block(rectangle(-3, -1, 6, 1), true)};
    scene.blocks.push_back(block(turned(rectangle(0, 0, 1, 1), radians(20)).colwise() + Vec2(beside, 0.1)));
    scene.blocks.back().velocity = {0, -4.4};
    const BuiltScene built = build(scene);
    run(*built.stepper, 8);
    return momentum(*built.stepper, seam ? 2 : 1);
  };
  for (const std::optional<double> restitution : {std::optional<double>(), std::optional<double>(1.)})
    for (const double beside : {0., 1e-6, -1e-6}) {
      const Vec2 on_one = momentum_after(false, restitution, beside);
      EXPECT_LT((momentum_after(true, restitution, beside) - on_one).norm(), 1e-6 * 2500 * 4.4) << beside;
      EXPECT_LT(std::abs(on_one.x()), 1e-6 * 2500 * 4.4) << "level ground without friction";
    }
}

/// What a stage removes covers nothing: a block slides against the corner that comes out so.
TEST(Seam, OfABlockThatIsRemovedIsNone) {
  Scene scene = smooth_rock(std::nullopt, 5e-3);
  scene.analysis.gravity = {0, -9.8};
  scene.blocks = {block(rectangle(-6, -2, 6, 1), true), block(rectangle(0, -2, 4, 2), true),
                  block(rectangle(-0.2, -0.4, 0.2, 0.4), true), block(rectangle(-1.3, -1, 1, 1))};
  scene.blocks[3].velocity = {1, 0};
  StageDescription with = scene.stage("with"), without = scene.stage("without");
  with.analysis.steps = 3;
  without.analysis.steps = 120;
  without.removed = {2};
  scene.stages = {with, without};
  const BuiltScene built = run(scene);
  EXPECT_NEAR(travel(*built.stepper, 3).x(), 0.3, 1e-3);
  EXPECT_LT(std::abs(momentum(*built.stepper, 3).x()), 0.02 * 2500);
}

/// A corner meets an edge that turns by 3 degrees in a step: whenever it does, no energy is lost or won.
TEST(TurningEdge, ReturnsWhatMeetsItAtAnyTimeOfAStep) {
  for (const Scheme scheme : {Scheme::decaying, Scheme::midpoint})
    for (int phase = 0; phase < 20; ++phase) {
      Scene scene = smooth_rock(1, 5e-3);
      scene.analysis.scheme = scheme;
      scene.blocks = {block(turned(rectangle(-0.6, -1.1, 1.2, 1), radians(-14))),
                      block(turned(rectangle(0.077, 0.05, 0.8, 0.8), radians(20), {0.077, 0.05}))};
      scene.blocks[0].angular_velocity = 10;
      scene.blocks[1].velocity = {5, -2};
      scene.blocks[1].vertices.colwise() -= phase / 20. * 5e-3 * scene.blocks[1].velocity;
      const BuiltScene built = build(scene);
      const double before = built.stepper->energy().now.kinetic;
      run(*built.stepper, 12);
      EXPECT_GT(built.stepper->counts().impacts, 0) << phase;
      EXPECT_NEAR(built.stepper->energy().now.kinetic, before, 1e-4 * before) << phase;
    }
}

TEST(RowOfSquares, EachPassesOnWhatItGot) {
  for (int n : {2, 4})
    for (double gap : {0., 0.01})
      for (double restitution : {1., 0.6})
        for (double time_step : {5e-3, 1e-3}) {
          const BuiltScene built = build(row_of_squares(n, gap, restitution, time_step));
          Stepper& stepper = *built.stepper;
          const double start = stepper.energy().now.kinetic;
          double most = start;
          for (int step = 0; step < std::lround(1 / time_step); ++step) {
            run(stepper, 1);
            most = std::max(most, stepper.energy().now.kinetic + stepper.energy().now.elastic);
          }
          EXPECT_LE(most, start * (1 + 1e-9)) << n << ' ' << gap << ' ' << restitution << ' ' << time_step;
          EXPECT_NEAR(
              momentum(stepper, n).x() / momentum(*build(row_of_squares(n, gap, 0, 1)).stepper, 0).x(),
              std::pow((1 + restitution) / 2, n), 1e-6)
              << gap << ' ' << time_step;
          if (restitution == 1) {
            EXPECT_NEAR(stepper.energy().now.kinetic, start, 1e-9 * start);
          }
          EXPECT_EQ(stepper.counts().limited_impacts, 0);
        }
}

/// In the very first step, too, in which contacts that touch without force have no history.
TEST(RowOfSquares, PassesOnWhatItGetsInTheFirstStep) {
  Scene scene = row_of_squares(2, 0, 1, 0.01);
  scene.blocks[0] = block(rectangle(-1.03, 0, 1, 1));
  scene.blocks[0].velocity = {4, 0};
  scene.analysis.steps = 3;
  for (const Scheme scheme : {Scheme::decaying, Scheme::midpoint}) {
    scene.analysis.scheme = scheme;
    const BuiltScene built = run(scene);
    const double thrown = 2500 * 4;
    EXPECT_NEAR(momentum(*built.stepper, 0).x(), 0, 1e-6 * thrown);
    EXPECT_NEAR(momentum(*built.stepper, 2).x(), thrown, 1e-6 * thrown);
  }
}

TEST(RowOfSquares, NeverGainsEnergyByMidpoint) {
  for (double gap : {0., 0.01}) {
    Scene scene = row_of_squares(4, gap, 1, 5e-3);
    scene.analysis.scheme = Scheme::midpoint;
    const BuiltScene built = build(scene);
    const double start = built.stepper->energy().now.kinetic;
    double most = start;
    for (int step = 0; step < scene.analysis.steps; ++step) {
      run(*built.stepper, 1);
      most = std::max(most, built.stepper->energy().now.kinetic + built.stepper->energy().now.elastic);
    }
    EXPECT_LE(most, start * (1 + 1e-9)) << gap;
  }
}

/// A bar of squares, held sideways, flies against a wall: behind the wave that runs through it all is at
/// rest.
TEST(BarAgainstAWall, StopsBehindItsWave) {
  constexpr int n = 48;
  constexpr double young = 35e9, density = 2500, length = 0.5, speed = 0.1;
  const double stiffness = 1.2 * young,  // lambda + 2 mu at nu = .25
      transit = length / std::sqrt(stiffness / density);
  for (double part : {1., 0.5, 0.25}) {
    Scene scene;
    scene.analysis.gravity.setZero();
    scene.analysis.time_step = part * transit;
    scene.analysis.block_model = BlockModel::wachspress;
    scene.materials = {{"rock", density, young, 0.25}};
    scene.joints = {{"joint", 0, 0, 0, std::nullopt}};
    scene.contact.normal_stiffness = 40 * young;
    scene.contact.tangential_stiffness = 16 * young;
    scene.blocks = {block(rectangle(-1, -1, 1, 2), true)};
    for (int k = 0; k < n; ++k) {
      scene.blocks.push_back(block(rectangle(k * length, 0, length, length)));
      scene.blocks.back().velocity = {-speed, 0};
      scene.supports.push_back({k + 1, {0, 1, 2, 3}, false, true, {}});
    }
    const BuiltScene built = build(scene);
    run(*built.stepper, static_cast<int>(std::lround(n / (2 * part))));
    const auto velocity = [&](int k) {
      return momentum(*built.stepper, k + 1).x() / (density * length * length);
    };
    int front = 0;
    while (velocity(front) > -speed / 2) ++front;
    EXPECT_NEAR(front, n / 2, 1) << part;
    EXPECT_NEAR(velocity(0), 0, 1e-3 * speed) << part;
    EXPECT_NEAR(velocity(n - 1), -speed, 1e-3 * speed) << part;
  }
}

/// Both corners of a level face touch at the end of a step, one of them after it by round-off: that is one
/// impact, which does not turn the block.
TEST(FlatImpact, AtTheEndOfAStepDoesNotTurnABlock) {
  for (const Scheme scheme : {Scheme::decaying, Scheme::midpoint, Scheme::dda})
    for (const double restitution : {0.5, 1.0}) {
      SCOPED_TRACE(std::to_string(static_cast<int>(scheme)) + ' ' + std::to_string(restitution));
      Scene scene;
      scene.analysis.time_step = 0.01;
      scene.analysis.steps = 40;
      scene.analysis.max_displacement_ratio = 1;
      scene.materials = {{"rock", 2500, 20e9, 0.2}};
      scene.joints = {{"joint", 0, 0, 0, std::nullopt}};
      scene.contact.normal_stiffness = 8e11;
      scene.contact.tangential_stiffness = 3.2e11;
      scene.analysis.scheme = scheme;
      scene.analysis.gravity = Vec2(0, -10);
      scene.joints[0].restitution = restitution;
      scene.blocks = {block(rectangle(-5, -1, 10, 1), true), block(rectangle(0, 0.2, 1, 1))};
      const BuiltScene built = run(scene);
      EXPECT_LT(std::abs(built.stepper->state().rotation[1]), 1e-7);
      EXPECT_LT(std::abs(travel(*built.stepper, 1).x()), 1e-7);
    }
}

/// A round block that lands rolls on: its lowest vertex is stopped by friction, and the others, which would
/// have come while a wave crosses the block, do not come any more. By hand: v' = v - v / (1 + m r^2 / I).
TEST(RoundBlock, RollsWhenItLandsHoweverManyVerticesItHas) {
  for (const int n : {16, 64}) {
    Scene scene = default_mechanics(rock_scene(1e-3, 60));
    scene.analysis.block_model = BlockModel::affine;
    scene.analysis.max_displacement_ratio = 1;
    scene.materials = {{"rock", 2500, 2e10, 0.25}};
    scene.joints[0].friction_angle = 35;
    scene.joints[0].restitution = 0.5;
    const double r = 0.5, v = 3, fall = 9;
    Points disk(2, n);
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * k / n - std::numbers::pi / 2;
      disk.col(k) << r * std::cos(angle), r * std::sin(angle) + r + 0.1;
    }
    scene.blocks = {block(rectangle(-5, -1, 10, 1), true), block(disk)};
    scene.blocks[1].velocity = {v, -fall};
    const BuiltScene built = run(scene);
    const Block& block = built.stepper->blocks().block(1);
    const double m = block.mass_total(), inertia = m * r * r * (2 + std::cos(2 * std::numbers::pi / n)) / 6;
    const RigidVelocity after =
        ddacontact::rigid_velocity(block, built.stepper->state(), built.stepper->state().velocity);
    EXPECT_NEAR(after.linear.x(), v * (1 - 1 / (1 + m * r * r / inertia)), 0.01 * v) << n;
    EXPECT_NEAR(after.linear.y(), 0.5 * std::hypot(fall, std::sqrt(2 * 10 * 0.1)) - 10 * (0.06 - 0.1 / fall),
                0.1)
        << n;
  }
}

/// A roller above the corner that meets the floor: next to nothing of the block's motion is free to stop
/// there, and an impulse for what only deformation could stop would turn the block the faster.
TEST(Roller, AboveTheCornerThatLandsTakesNoEnergyFromNowhere) {
  for (const Scheme scheme : {Scheme::midpoint, Scheme::decaying, Scheme::dda, Scheme::central_difference}) {
    Scene scene;
    scene.analysis.time_step = 1e-3;
    scene.analysis.steps = 40;
    scene.analysis.scheme = scheme;
    scene.analysis.gravity = Vec2(0, -9.8);
    scene.materials = {{"rock", 2500, 5e9, 0.2}};
    scene.joints = {{"joint", 0, 0, 0, std::nullopt}};
    scene.contact.normal_stiffness = 2e11;
    scene.contact.tangential_stiffness = 8e10;
    Points tilted(2, 4);
    tilted << 0, 1, 1.03, 0.03,  //
        0.03, 0, 1, 1.03;
    scene.blocks = {block(rectangle(-2, -1, 8, 1), true), block(tilted)};
    scene.blocks[1].angular_velocity = 1;
    scene.supports = {{1, {2}, false, true, {}}};
    const BuiltScene built = build(scene);
    const double start = built.stepper->energy().now.kinetic;
    for (int k = 0; k < scene.analysis.steps; ++k) {
      run(*built.stepper, 1);
      ASSERT_LE(built.stepper->energy().now.kinetic, 1.5 * start)
          << static_cast<int>(scheme) << " step " << k;
    }
  }
}
