// Shaking of the ground: against Newmark's block and against a support that moves.
#include <tests/ddacontact/simple_scenes.hpp>

using namespace support;

namespace {

constexpr double friction = 0.2, fall = 10;  // of the block, m/s2

/// Like a record: waves that come and go, sampled every 10 ms.
std::vector<Vec3> record() {
  std::vector<Vec3> entries;
  for (int k = 0; k <= 300; ++k) {
    const double t = 0.01 * k, envelope = std::sin(std::numbers::pi * t / 3);
    entries.emplace_back(t, envelope * (4 * std::sin(4 * t) + 2 * std::sin(9 * t + 1)), 0);
  }
  return entries;
}

/// A stiff block of 2 x 1 m on a base.
Scene block_on_ground(double time_step) {
  Scene scene = default_mechanics(rock_scene(time_step, static_cast<int>(std::round(3 / time_step))));
  scene.analysis.block_model = BlockModel::affine;
  scene.materials[0].young = 1e10;
  scene.contact.normal_stiffness = 4e11;
  scene.contact.tangential_stiffness = 1.6e11;
  scene.joints[0].friction_angle = std::atan(friction) * 180 / std::numbers::pi;
  scene.blocks = {block(rectangle(-5, -1, 12, 1)), block(rectangle(0, 0, 2, 1))};
  scene.blocks[0].fixed = true;
  return scene;
}

Scene shaken_ground(double time_step) {
  Scene scene = block_on_ground(time_step);
  scene.quakes = {{ddacontact::history_function(TimeFunction::Kind::history, record())}};
  return scene;
}

/// How far a rigid block slides relative to the ground by Coulomb's law, by small steps.
double newmark_block() {
  const TimeFunction ground = ddacontact::history_function(TimeFunction::Kind::history, record());
  const double dt = 1e-5, most = friction * fall;
  double v = 0, u = 0;
  for (double t = dt / 2; t < 3; t += dt) {
    const double pull = -ground.at(t, 0).x();
    if (v == 0 && std::abs(pull) <= most) continue;
    const double drag = v != 0 ? -std::copysign(most, v) : -std::copysign(most, pull),
                 next = v + dt * (pull + drag);
    const bool stops = v * next < 0;
    u += stops ? 0 : dt * (v + next) / 2;
    v = stops ? 0 : next;
  }
  return u;
}

double slid(const Scene& scene) {
  const BuiltScene built = run(scene);
  return travel(*built.stepper, 1).x() - travel(*built.stepper, 0).x();
}

}  // namespace

TEST(Quake, IsTheSameAsAGroundThatMoves) {
  Scene moving = block_on_ground(0.0025);
  moving.blocks[0].fixed = false;
  moving.supports = {{0,
                      {0, 1, 2, 3},
                      true,
                      true,
                      ddacontact::history_function(TimeFunction::Kind::acceleration_history, record())}};
  const double relative = slid(shaken_ground(0.0025));
  EXPECT_NEAR(slid(moving), relative, 0.01 * std::abs(relative));
}

/// Free of the ground a block falls away from it by the double integral of the acceleration.
TEST(Quake, LeavesABlockBehindThatNothingHolds) {
  Scene scene = shaken_ground(0.0025);
  scene.analysis.gravity.setZero();
  scene.blocks[1] = block(rectangle(0, 3, 2, 1));
  const TimeFunction ground =
      ddacontact::history_function(TimeFunction::Kind::acceleration_history, record());
  const BuiltScene built = run(scene);
  EXPECT_NEAR(travel(*built.stepper, 1).x(), -ground.at(3, 0).x(), 1e-4 * std::abs(ground.at(3, 0).x()));
}

/// A pulse of 2 ms that would make 1 m/s, between the ends of steps of 10 ms.
TEST(Quake, APulseShorterThanAStepCountsWhole) {
  const std::vector<Vec3> pulse{{0.021, 0, 0}, {0.022, 1000, 0}, {0.023, 0, 0}};
  for (const Scheme scheme : {Scheme::decaying, Scheme::midpoint, Scheme::central_difference}) {
    Scene scene = block_on_ground(0.01);
    scene.analysis.scheme = scheme;
    scene.analysis.gravity.setZero();
    scene.analysis.steps = 5;
    scene.blocks[1] = block(rectangle(0, 3, 2, 1));
    scene.quakes = {{ddacontact::history_function(TimeFunction::Kind::history, pulse)}};
    const BuiltScene built = run(scene);
    const double mass = built.stepper->blocks().block(1).mass_total();
    EXPECT_NEAR(momentum(*built.stepper, 1).x() / mass, -1, 1e-12) << static_cast<int>(scheme);
  }
}

/// In a lift that accelerates upwards blocks bounce as under gravity.
TEST(Quake, AnElasticBounceKeepsItsEnergy) {
  constexpr double height = 0.1112, fall_rate = 9.81;
  Scene scene = block_on_ground(0.005);
  scene.analysis.gravity.setZero();
  scene.joints[0].restitution = 1;
  scene.blocks[1] = block(rectangle(0, height, 2, 1));
  scene.blocks[1].velocity = {0, -1};
  scene.quakes = {
      {ddacontact::history_function(TimeFunction::Kind::history, {{0, 0, fall_rate}, {9, 0, fall_rate}})}};
  const BuiltScene built = build(scene);
  const double mass = built.stepper->blocks().block(1).mass_total(), energy = 0.5 + fall_rate * height;
  run(*built.stepper, 200);  // to the middle of its third flight
  const double v = momentum(*built.stepper, 1).y() / mass, y = height + travel(*built.stepper, 1).y();
  EXPECT_NEAR(v * v / 2 + fall_rate * y, energy, 1e-6 * energy);
  EXPECT_GT(built.stepper->counts().impacts, 2);
}

TEST(Quake, WakesWhatSleeps) {
  Scene scene = shaken_ground(0.005);
  std::vector<Vec3> late = record();
  for (Vec3& entry : late) entry[0] += 1;
  scene.quakes = {{ddacontact::history_function(TimeFunction::Kind::history, late)}};
  scene.analysis.steps = 800;
  BuiltScene built = build(scene);
  run(*built.stepper, 200);
  EXPECT_LT(travel(*built.stepper, 1).norm(), 1e-6);
  run(*built.stepper, 600);
  const double exact = newmark_block();
  EXPECT_NEAR(travel(*built.stepper, 1).x(), exact, 0.02 * std::abs(exact));
}

namespace {

constexpr double width = 0.5, height = 2;  // of a slender block, m

/// Whether a rigid block that rocks about its corner passes its balance under a push of the ground (Housner
/// 1963), by the classical Runge-Kutta method.
bool overturns_by_theory(double acceleration, double duration) {
  const double slenderness = std::atan(width / height), radius = std::hypot(width, height) / 2, dt = 1e-4;
  const auto rate = [&](double t, const Vec2& y) -> Vec2 {
    const double to_balance = slenderness - y[0], push = t < duration ? acceleration : 0;
    return {y[1], 3 / (4 * radius) * (push * std::cos(to_balance) - fall * std::sin(to_balance))};
  };
  Vec2 y = Vec2::Zero();
  for (double t = 0; t < 20; t += dt) {
    const Vec2 a = rate(t, y), b = rate(t + dt / 2, y + dt / 2 * a), c = rate(t + dt / 2, y + dt / 2 * b),
               d = rate(t + dt, y + dt * c);
    y += dt / 6 * (a + 2 * b + 2 * c + d);
    if (y[0] >= slenderness) return true;
    if (y[0] < 0) return false;
  }
  return false;
}

double threshold(double duration) {
  double low = 1, high = 20;
  while (high - low > 1e-4) {
    const double middle = (low + high) / 2;
    (overturns_by_theory(middle, duration) ? high : low) = middle;
  }
  return (low + high) / 2;
}

bool overturns(double acceleration, double duration) {
  Scene scene = block_on_ground(0.0025);
  scene.analysis.steps = 1200;
  scene.joints[0].friction_angle = 45;
  scene.blocks[1] = block(rectangle(0, 0, width, height));
  scene.quakes = {{ddacontact::history_function(TimeFunction::Kind::history,
                                                {{0, -acceleration, 0}, {duration, -acceleration, 0}})}};
  const BuiltScene built = run(scene);
  return std::abs(built.stepper->state().rotation[1]) > std::atan(width / height);
}

}  // namespace

/// West's limit for a push that lasts, and those of pulses (.3 s: 4.51 m/s2, .6 s: 3.12).
TEST(Quake, OverturnsASlenderBlockAtTheKnownAccelerations) {
  EXPECT_NEAR(threshold(10), fall * width / height, 1e-3);
  for (const double duration : {0.3, 0.6, 3.0}) {
    const double known = threshold(duration);
    EXPECT_FALSE(overturns(0.99 * known, duration)) << duration;
    EXPECT_TRUE(overturns(1.01 * known, duration)) << duration;
  }
}

namespace {

/// For 1.5 s, the ground accelerated from one time to another; at rest before and after.
Scene pushed_ground(double from, double to, double acceleration) {
  Scene scene = block_on_ground(0.01);
  scene.analysis.scheme = Scheme::decaying;
  scene.analysis.steps = 150;
  scene.quakes = {{ddacontact::history_function(TimeFunction::Kind::history,
                                                {{from, acceleration, 0}, {to, acceleration, 0}})}};
  return scene;
}

}  // namespace

/// A record is 0 outside its entries: where it begins or ends with a jump, blocks that sleep feel that.
TEST(Quake, ARecordThatBeginsWithAJumpWakesBlocks) {
  const double push = 1.5 * friction * fall, exact = (push - friction * fall) / 2;
  Scene scene = pushed_ground(0.5, 1.5, -push);
  EXPECT_NEAR(slid(scene), exact, 0.03 * exact);
  scene.analysis.skip.sleep = false;
  EXPECT_NEAR(slid(scene), exact, 0.03 * exact);
}

/// By friction that held it against the record, and is gone with its end.
TEST(Quake, ARecordThatEndsWithAJumpWakesBlocks) {
  const BuiltScene built = run(pushed_ground(0, 1, -0.5 * friction * fall));
  double shear = 0;
  for (const ddacontact::ContactRecord& contact : built.stepper->contacts()) shear += contact.shear;
  EXPECT_NEAR(shear, 0, 1);
}

/// The work of a force that changes within the steps, against the velocity that it gives a free block.
TEST(Quake, WorksWhatItGivesAFreeBlock) {
  Scene scene = shaken_ground(0.01);
  scene.analysis.gravity = Vec2::Zero();
  scene.blocks.erase(scene.blocks.begin());
  scene.analysis.steps = 100;
  const BuiltScene built = run(scene);
  const Energy& energy = built.stepper->energy().now;
  EXPECT_NEAR(energy.external, energy.kinetic, 1e-3 * energy.kinetic);
  EXPECT_LT(built.stepper->energy().created(), 1e-3);
}
