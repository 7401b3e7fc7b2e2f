#include <ddacontact/contact/contact_builder.hpp>
#include <ddacontact/contact/dashpots.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace support;

namespace {

constexpr double stiffness = 1e6, ratio = 0.05;  // of the joint, Pa/m, and of its dashpot

/// A block of 4 t on a joint of 2 m that is soft against it, from rest under its weight.
Scene oscillator() {
  Scene scene = default_mechanics(rock_scene(1e-3, 1200), Scheme::midpoint);
  scene.materials[0].young = 1e10;
  scene.joints[0].friction_angle = 30;
  scene.joints[0].normal_stiffness = scene.joints[0].shear_stiffness = stiffness;
  scene.joints[0].dashpot = ratio;
  scene.blocks = {block(rectangle(-1, -1, 4, 1), true), block(rectangle(0, 0, 2, 1))};
  return scene;
}

/// Of block 1, by what is left of its oscillation under its weight after a period: exp(-2 pi zeta).
double damping_ratio(const Scene& scene) {
  const double omega = std::sqrt(2 * stiffness / 4000);
  const BuiltScene built = build(scene);
  const Range vertices = built.stepper->blocks().block(1).vertices();
  const auto sinks = [&](double until) {
    while (built.stepper->state().time < until - 1e-9) EXPECT_TRUE(built.stepper->step());
    return -vertices.columns_of(built.stepper->blocks().displacements(built.stepper->state())).row(1).mean();
  };
  const double period = 2 * std::numbers::pi / omega, rest = 10 / (omega * omega),
               first = sinks(period / 2) - rest, second = sinks(3 * period / 2) - rest;
  return std::log(first / second) / (2 * std::numbers::pi);
}

}  // namespace

/// Whatever the number of contacts that share the joint.
TEST(Dashpots, DampAVibrationByTheirRatioWhateverTheMesh) {
  for (const int cells : {0, 4, 64}) {
    Scene scene = oscillator();
    for (BlockDescription& of : scene.blocks) of.model = cells == 0 ? BlockModel::affine : BlockModel::mesh;
    scene.blocks[1].mesh.cells = std::max(cells, 1);
    EXPECT_NEAR(damping_ratio(scene), ratio, 0.02 * ratio) << cells;
  }
}

/// A plate that is held at its lower corners is a wall for what rests on it, however light it is.
TEST(Dashpots, APlateHeldInPartIsAWall) {
  Scene scene = oscillator();
  scene.blocks[0] = block(rectangle(0, -0.2, 2, 0.2));
  for (BlockDescription& of : scene.blocks) of.model = BlockModel::affine;
  scene.supports = {{0, {0, 1}, true, true, {}}};
  EXPECT_NEAR(damping_ratio(scene), ratio, 0.05 * ratio);
}

TEST(Dashpots, HaveNoForceBeforeTheirContactCloses) {
  for (const Scheme scheme : {Scheme::midpoint, Scheme::decaying, Scheme::backward_euler}) {
    Scene scene = oscillator();
    scene.analysis.scheme = scheme;
    scene.analysis.gravity.setZero();
    scene.analysis.time_step = 5e-4;
    scene.joints[0].dashpot = 1;
    scene.blocks[1] = block(rectangle(0, 0.03, 2, 1));
    scene.blocks[1].velocity = {0, -1};
    for (BlockDescription& of : scene.blocks) of.model = BlockModel::affine;
    const BuiltScene built = build(scene);
    while (built.stepper->state().time < 0.0295) ASSERT_TRUE(built.stepper->step());
    EXPECT_NEAR(built.stepper->energy().now.kinetic, 2000, 1e-6) << "0.5 mm above";
    while (built.stepper->state().time < 0.2) ASSERT_TRUE(built.stepper->step());
    const Energy& now = built.stepper->energy().now;
    EXPECT_GT(now.damping_dissipated, 1500);
    EXPECT_LE(now.damping_dissipated, 2000);
    EXPECT_GE(now.numerical_dissipated, -1);
  }
}

/// Two blocks of the same mass, one on the other.
TEST(Dashpots, DoNotDependOnTheOrderOfBlocks) {
  Scene scene = oscillator();
  scene.analysis.steps = 150;
  scene.blocks.push_back(block(rectangle(0, 1, 2, 1)));
  for (BlockDescription& of : scene.blocks) of.model = BlockModel::affine;
  Scene swapped = scene;
  std::swap(swapped.blocks[1], swapped.blocks[2]);
  const BuiltScene one = run(scene), other = run(swapped);
  EXPECT_NEAR(one.stepper->energy().now.damping_dissipated, other.stepper->energy().now.damping_dissipated,
              1e-6);
}

/// The floor below and the wall beside it damp what moves along their own normals.
TEST(Dashpots, ShareABlockByStiffnessAlongTheirNormals) {
  Scene scene = oscillator();
  scene.blocks = {block(rectangle(-1, -1, 4, 1), true), block(rectangle(2, 0, 1, 3), true),
                  block(rectangle(0, 0, 2, 1))};
  for (BlockDescription& of : scene.blocks) of.model = BlockModel::affine;
  const BuiltScene built = build(scene);
  const BlockSystem& blocks = built.stepper->blocks();
  const BlockState& state = built.stepper->state();
  const ContactProperties& properties = built.stepper->contact_properties();
  ContactBuilder builder(blocks, properties);
  std::vector<Contact> contacts =
      builder.build_first(state, VectorXd::Zero(state.velocity.size()), {0.1, 0.1, 0.1});
  const auto sum = [&](int other) {
    double all = 0;
    for (const Contact& contact : contacts)
      if (std::ranges::count(contact.pair.blocks(), other)) all += contact.damping;
    return all;
  };
  const auto critical = [](double length) { return 2 * std::sqrt(stiffness * length * 4000); };
  set_dashpots(blocks, properties, 0.01, contacts);
  EXPECT_NEAR(sum(0), ratio * critical(2) / 0.01, 1e-4 * sum(0));
  EXPECT_NEAR(sum(1), ratio * critical(1) / 0.01, 1e-4 * sum(1));
}
