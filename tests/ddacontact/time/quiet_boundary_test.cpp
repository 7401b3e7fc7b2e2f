// Faces that let waves out: what comes back of a pulse, what a wave that comes in does at a free surface.
#include <tests/ddacontact/simple_scenes.hpp>

using namespace support;

namespace {

constexpr double stiffness = 4e9, mass_density = 2500;  // Poisson's ratio 0: waves along a bar are plane
const double wave_speed = std::sqrt(stiffness / mass_density);

/// A bar of square cells along x, its lower left corner at the origin.
Scene bar(double length, int cells, double time_step) {
  Scene scene;
  scene.analysis.time_step = time_step;
  scene.analysis.gravity = Vec2(0, 0);
  scene.analysis.scheme = Scheme::midpoint;
  scene.analysis.max_displacement_ratio = 1;
  scene.materials = {{"rock", mass_density, stiffness, 0}};
  scene.joints = {{"joint", 0, 0, 0, std::nullopt}};
  scene.contact.normal_stiffness = 40 * stiffness;
  scene.contact.tangential_stiffness = 16 * stiffness;
  BlockDescription one = block(rectangle(0, 0, length, length / cells));
  one.model = BlockModel::mesh;
  one.mesh.kind = ddacontact::CellKind::quads;
  one.mesh.cells = cells;
  scene.blocks = {one};
  return scene;
}

/// (1 - cos) / 2 over a period, of height one; along x or y.
TimeFunction pulse(double period, const Vec2& height) {
  std::vector<Vec3> entries;
  for (int k = 0; k <= 200; ++k) {
    const double size = (1 - std::cos(2 * std::numbers::pi * k / 200)) / 2;
    entries.emplace_back(period * k / 200, size * height.x(), size * height.y());
  }
  return ddacontact::history_function(TimeFunction::Kind::history, entries);
}

double energy(const Stepper& stepper) {
  return stepper.energy().now.kinetic + stepper.energy().now.elastic;
}

}  // namespace

TEST(QuietBoundary, LetsAPulseOut) {
  constexpr int cells = 50;
  constexpr double length = 50;
  for (const Scheme scheme : {Scheme::midpoint, Scheme::central_difference}) {
    const double dt = 0.25 * length / cells / wave_speed;
    Scene scene = bar(length, cells, dt);
    scene.analysis.scheme = scheme;
    scene.quiet_boundaries = {{Vec2(length, 0), Vec2(length, 1), {{0, 1}}, {}}};
    Load push = pressure_load(0, 3, 0);
    push.force = pulse(20 / wave_speed, {1e5, 0});
    scene.loads = {push};
    BuiltScene built = build(scene);
    // Half way along the bar the pulse has the energy that is to go out; later it would be back.
    run(*built.stepper, 120);
    const double before = energy(*built.stepper);
    ASSERT_GT(before, 0);
    run(*built.stepper, 240);
    EXPECT_LT(energy(*built.stepper), 0.01 * before) << static_cast<int>(scheme);
    EXPECT_NEAR(built.stepper->energy().now.damping_dissipated, before, 0.05 * before);
  }
}

/// At a free surface the velocity of a wave that comes in is doubled; then it goes out where it came in.
TEST(QuietBoundary, LetsAWaveInThatDoublesAtAFreeSurface) {
  constexpr int cells = 50;
  constexpr double length = 50;
  const double dt = 0.25 * length / cells / wave_speed;
  Scene scene = bar(length, cells, dt);
  const double period = 20 / wave_speed;
  scene.quiet_boundaries = {{Vec2(0, 0), Vec2(0, 1), {{0, 3}}, pulse(period, {0.1, 0})}};
  scene.monitors = {{"end", 0, ddacontact::Monitor::Kind::vertex, Vec2(0, 0), 1}};
  BuiltScene built = build(scene);
  double fastest = 0, largest = 0;
  for (int step = 0; step < 560; ++step) {
    ASSERT_TRUE(built.stepper->step());
    fastest = std::max(fastest, ddacontact::observe(built.monitor_targets[0], *built.stepper).velocity.x());
    largest = std::max(largest, energy(*built.stepper));
  }
  EXPECT_NEAR(fastest, 0.2, 0.002);
  EXPECT_LT(energy(*built.stepper), 0.01 * largest);
}

/// The stress of the surroundings balances that of the block: nothing moves.
TEST(QuietBoundary, BearsTheStressOfTheSurroundings) {
  Scene scene = bar(10, 10, 0.001);
  scene.blocks[0].stress = Vec3(-1e6, 0, 0);
  scene.quiet_boundaries = {{Vec2(0, 0), Vec2(0, 1), {{0, 3}, {0, 1}}, {}}};
  scene.analysis.steps = 50;
  const BuiltScene built = run(scene);
  const Points moved = built.stepper->blocks().displacements(built.stepper->state());
  EXPECT_LT(moved.cwiseAbs().maxCoeff(), 1e-12);
}

/// A stress that grows with the depth balances gravity within every block and between blocks: a column on a
/// quiet boundary stays where it is. With the stress of its centroid throughout, the lowest block sinks at
/// 1.5 mm/s, as half of its weight is missing below.
TEST(QuietBoundary, BearsTheWeightThatTheStressBalances) {
  for (const BlockModel model : {BlockModel::wachspress, BlockModel::affine, BlockModel::mesh}) {
    SCOPED_TRACE(static_cast<int>(model));
    Scene scene = bar(1, 16, 0.01);
    scene.analysis.scheme = Scheme::decaying;
    scene.analysis.gravity = Vec2(0, -10);
    scene.analysis.steps = 100;
    scene.blocks.clear();
    for (int k = 0; k < 3; ++k) {
      BlockDescription one = block(rectangle(0, k, 1, 1));
      one.model = model;
      one.mesh.cells = 16;
      one.stress_gradient = Vec3(0, 10 * mass_density, 0);
      one.stress = one.stress_gradient * (k + 0.5 - 3);
      scene.blocks.push_back(one);
    }
    scene.quiet_boundaries = {{Vec2(0, 0), Vec2(1, 0), {{0, 0}}, {}}};
    const BuiltScene built = run(scene);
    EXPECT_LT(built.stepper->blocks().displacements(built.stepper->state()).cwiseAbs().maxCoeff(), 1e-7);
    EXPECT_LT(built.stepper->state().velocity.cwiseAbs().maxCoeff(), 1e-7);
  }
}
