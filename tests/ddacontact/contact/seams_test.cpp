#include <ddacontact/contact/contact_builder.hpp>
#include <ddacontact/contact/seams.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <gtest/gtest.h>

using namespace support;

namespace {

/// Friction of the corners of two plates of 3 m and 1 m below a block that reaches over the seam, by the
/// block of each vertex; the joint of the second plate is another one.
std::map<int, double> friction_at_seam(double gap, bool same_material = false, double drop = 0,
                                       bool held = true) {
  constexpr double rough = 0.8, smooth = 0.2;
  Scene scene = rock_scene(0.1, 1);
  scene.blocks = {block(rectangle(0, -1, 3, 1), held), block(rectangle(3 + gap, -1 - drop, 1, 1), held),
                  block(rectangle(1, 0, 3 + gap, 1))};
  const BuiltScene built = build(scene);
  const BlockSystem& blocks = built.stepper->blocks();
  const BlockState& state = built.stepper->state();
  const ContactProperties properties{1e9,
                                     4e8,
                                     JointTable({{{rough}, std::nullopt}, {{smooth}, {{0, 1}}}}),
                                     {0, same_material ? 0 : 1, 0},
                                     ContactMethod::classic,
                                     0};
  ContactBuilder builder(blocks, properties);
  std::vector<Contact> contacts =
      builder.build_first(state, VectorXd::Zero(state.velocity.size()), {0.1, 0.1, 0.1});
  share_friction_at_seams(blocks, state, properties, contacts);
  std::map<int, double> friction;
  for (const Contact& contact : contacts)
    if (contact.pair.vertex_block != 2 && contact.pair.edge_block == 2 &&
        std::abs(contact.motion.start.i.x()) < 1)
      friction[contact.pair.vertex_block] = contact.law.friction;
  return friction;
}

TEST(Seams, BothCornersHaveTheMeanFrictionByTheLengthsTheyStandFor) {
  // The block lies on 2 m of the first plate and on 1 m of the second.
  const double mean = (2 * 0.8 + 1 * 0.2) / 3;
  for (const auto& [block, friction] : friction_at_seam(0)) EXPECT_NEAR(friction, mean, 1e-12) << block;
  EXPECT_EQ(friction_at_seam(0).size(), 2);
}

TEST(Seams, CornersApartOrOfOneJointOrOfBlocksThatMoveKeepTheirOwn) {
  std::map<int, double> friction = friction_at_seam(1e-3);
  EXPECT_EQ(friction[0], 0.8);
  EXPECT_EQ(friction[1], 0.2);
  friction = friction_at_seam(0, false, 1e-3);
  EXPECT_EQ(friction[0], 0.8);
  EXPECT_EQ(friction.count(1), 0) << "the side of the other covers its corner";
  friction = friction_at_seam(0, false, 0, false);
  EXPECT_EQ(friction[0], 0.8);
  EXPECT_EQ(friction[1], 0.2) << "each bears what it weighs";
  friction = friction_at_seam(0, true);
  EXPECT_EQ(friction[0], 0.8);
  EXPECT_EQ(friction[1], 0.8);
}

}  // namespace
