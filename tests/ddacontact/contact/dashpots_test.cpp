#include <ddacontact/contact/contact_builder.hpp>
#include <ddacontact/contact/dashpots.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <numbers>

using namespace support;

namespace {

constexpr double stiffness = 1e6, ratio = 0.05;  // of the joint, Pa/m, and of its dashpot

/// A block of 4 t on a joint of 2 m that is soft against it, from rest under its weight.
Scene oscillator() {
  Scene scene = rock_scene(1e-3, 1200);
  scene.analysis.kinematics = Kinematics::corotational;
  scene.analysis.scheme = Scheme::midpoint;
  scene.contact.method = ContactMethod::staged;
  scene.contact.penetration_tolerance = 1e-6;
  scene.materials[0].young = 1e10;
  scene.joints[0].friction_angle = 30;
  scene.joints[0].normal_stiffness = scene.joints[0].shear_stiffness = stiffness;
  scene.joints[0].dashpot = ratio;
  scene.blocks = {block(rectangle(-1, -1, 4, 1), true), block(rectangle(0, 0, 2, 1))};
  return scene;
}

}  // namespace

/// exp(-zeta omega t) whatever the number of contacts that share the joint.
TEST(Dashpots, DampAVibrationByTheirRatioWhateverTheMesh) {
  const double omega = std::sqrt(2 * stiffness / 4000), period = 2 * std::numbers::pi / omega;
  for (const int cells : {0, 4, 64}) {
    Scene scene = oscillator();
    for (BlockDescription& of : scene.blocks) of.model = cells == 0 ? BlockModel::affine : BlockModel::mesh;
    scene.blocks[1].mesh.cells = std::max(cells, 1);
    const BuiltScene built = build(scene);
    const auto sinks = [&](double until) {
      while (built.stepper->state().time < until - 1e-9) EXPECT_TRUE(built.stepper->step());
      return -built.stepper->blocks().displacements(built.stepper->state()).rightCols(4).row(1).mean();
    };
    const double rest = 4000 * 10 / (2 * stiffness), first = sinks(period / 2) - rest,
                 second = sinks(3 * period / 2) - rest;
    EXPECT_NEAR(std::log(first / second) / (2 * std::numbers::pi), ratio, 0.02 * ratio) << cells;
  }
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
