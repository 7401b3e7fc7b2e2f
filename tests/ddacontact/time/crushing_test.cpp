/// \file Joints with a strength in compression: forces N act N / (2 strength) away from the corners.
#include "../simple_scenes.hpp"

#include <ddacontact/output/run_verdict.hpp>

using namespace support;

namespace {

Scene masonry(double strength) {
  Scene scene = rock_scene(0.01, 100);
  scene.analysis.mode = Mode::statics;
  scene.analysis.kinematics = Kinematics::corotational;
  scene.analysis.scheme = Scheme::decaying;
  scene.analysis.max_displacement_ratio = 0.1;
  scene.contact.method = ContactMethod::staged;
  scene.contact.penetration_tolerance = 1e-6;
  scene.materials[0].young = 2e12;
  scene.joints[0].friction_angle = 60;
  scene.joints[0].compressive_strength = strength;
  return scene;
}

/// 40 kN, 1 m wide and 2 m high, pushed at its top.
Scene wall(double strength, double push) {
  Scene scene = masonry(strength);
  scene.blocks = {block(rectangle(-1, -1, 3, 1), true), block(rectangle(0, 0, 1, 2))};
  scene.loads = {point_load(1, Vec2(0, 2), constant({push, 0}))};
  scene.loads[0].force.rise = 0.2;
  return scene;
}

/// Two stones of 100 kN, 5 m long and 1 m high, between abutments: a moment of 250 kN m in the middle.
Scene voussoir_beam(double strength) {
  Scene scene = masonry(strength);
  scene.blocks = {block(rectangle(-2, -1, 2, 3), true), block(rectangle(10, -1, 2, 3), true),
                  block(rectangle(0, 0, 5, 1)), block(rectangle(5, 0, 5, 1))};
  return scene;
}

bool stands(const Scene& scene) {
  BuiltScene built = build(scene);
  for (int k = 0; k < scene.n_steps(); ++k)
    if (!built.stepper->step()) return false;
  return built.stepper->is_at_rest() &&
         travel(*built.stepper, scene.blocks.size() == 2 ? 1 : 2).norm() < 0.05;
}

/// The forces of a joint in x.
double thrust(const Stepper& stepper, int a, int b) {
  double sum = 0;
  for (const ddacontact::ContactRecord& contact : stepper.contacts())
    if (std::minmax(contact.pair.vertex_block, contact.pair.edge_block) == std::minmax(a, b))
      sum += contact.normal;
  return sum;
}

}  // namespace

/// M = N (b / 2 - N / (2 strength)).
TEST(Crushing, LowersTheMomentThatAWallBears) {
  for (const double strength : {1e6, 2e5, 8e4}) {
    const double most = 40e3 * (0.5 - 40e3 / (2 * strength)) / 2;
    EXPECT_TRUE(stands(wall(strength, 0.99 * most))) << strength;
    EXPECT_FALSE(stands(wall(strength, 1.01 * most))) << strength;
  }
}

/// H (1 m - H / strength) = 250 kN m has a root down to a strength of 1 MPa.
TEST(Crushing, BringsAVoussoirBeamDown) {
  for (const double strength : {1e9, 4e6, 2e6, 1.2e6}) {
    const BuiltScene built = run(voussoir_beam(strength));
    const double H = strength / 2 * (1 - std::sqrt(1 - 1e6 / strength));
    EXPECT_NEAR(thrust(*built.stepper, 2, 3), H, 1e-3 * H) << strength;
    EXPECT_TRUE(built.stepper->is_at_rest());
  }
  EXPECT_TRUE(stands(voussoir_beam(1.02e6)));
  EXPECT_FALSE(stands(voussoir_beam(0.98e6)));
}

TEST(Crushing, OfAWholeJointIsWarnedOf) {
  const auto warnings = [](double strength) {
    Scene scene = wall(strength, 0);
    scene.analysis.steps = 5;
    return std::ranges::count_if(ddacontact::warnings_of(*run(scene).stepper), [](const std::string& text) {
      return text.find("compressive_strength") != std::string::npos;
    });
  };
  EXPECT_EQ(warnings(41e3), 0);
  EXPECT_EQ(warnings(39e3), 1);
}
