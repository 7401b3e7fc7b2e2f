#include <ddacontact/contact/contact_positions.hpp>
#include <ddacontact/contact/contact_properties.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <gtest/gtest.h>

using namespace support;

namespace {

/// Joint 0 everywhere, joints 1 and 2 on edges 2 and 3 of block 1.
ContactProperties two_joints(const JointStrength& here, const JointStrength& there) {
  return {.normal_stiffness = 1e9,
          .tangential_stiffness = 4e8,
          .joints = JointTable({{{0.1}, std::nullopt}, {here, {{7, 7}}}, {there, {{8, 8}}}}),
          .materials = {0, 0},
          .edge_joints = {{}, {-1, -1, 1, 2}}};
}
ContactRecord of_length(double length, double beyond = 0) {
  ContactRecord contact;
  contact.pair = {0, 0, 1, 2};
  contact.history.length = length;
  contact.history.length_beyond = static_cast<float>(beyond);
  contact.history.state = ContactState::stick;
  contact.history.bonded = true;
  return contact;
}

}  // namespace

TEST(ContactProperties, StressesActOverTheLength) {
  JointStrength joint{0.5, 3e3, 2e3};
  const ContactProperties rigid = two_joints(joint, {});
  JointLaw law = rigid.law(of_length(0.5));
  EXPECT_EQ(law.friction, 0.5);
  EXPECT_EQ(law.cohesion, 1.5e3);
  EXPECT_EQ(law.tension, 1e3);
  EXPECT_EQ(law.normal_stiffness, 1e9);
  EXPECT_EQ(law.tangential_stiffness, 4e8);
  EXPECT_FALSE(law.compliant || law.glued || law.ductile);
  joint.normal_stiffness = 6e6;
  joint.shear_stiffness = 2e6;
  law = two_joints(joint, {}).law(of_length(0.5));
  EXPECT_TRUE(law.compliant);
  EXPECT_EQ(law.normal_stiffness, 3e6);
  EXPECT_EQ(law.tangential_stiffness, 1e6);
  EXPECT_FALSE(two_joints(joint, {}).law(of_length(0)).compliant) << "a vertex alone";
}

TEST(ContactProperties, AnEdgeHasItsOwnJointOrThatOfTheMaterials) {
  const ContactProperties properties = two_joints({0.5}, {0.9});
  EXPECT_EQ(properties.strength({0, 0, 1, 2}).friction, 0.5);
  EXPECT_EQ(properties.strength({0, 0, 1, 3}).friction, 0.9);
  EXPECT_EQ(properties.strength({0, 0, 1, 0}).friction, 0.1);
}

/// A quarter of the length lies on the joint of the next edge, or of that before.
TEST(ContactProperties, WhereTwoJointsMeetEachBearsOverItsPart) {
  const JointStrength here{0.4, 4e3, 8e3};
  JointStrength there{0.8, 8e3, 0};
  const JointLaw law = two_joints(here, there).law(of_length(2, 0.5));
  EXPECT_DOUBLE_EQ(law.friction, 0.5);
  EXPECT_DOUBLE_EQ(law.cohesion, 1.5 * 4e3 + 0.5 * 8e3);
  EXPECT_DOUBLE_EQ(law.tension, 1.5 * 8e3);
  EXPECT_DOUBLE_EQ(two_joints(here, there).law(of_length(2, -0.5)).friction, 0.75 * 0.4 + 0.25 * 0.1);
  EXPECT_DOUBLE_EQ(two_joints(here, there).law(of_length(2, 3)).friction, 0.8) << "no more than all of it";
  there.glued = there.ductile = true;
  EXPECT_TRUE(two_joints(here, there).law(of_length(2, 0.5)).glued);
  EXPECT_TRUE(two_joints(here, there).law(of_length(2, 0.5)).ductile);
  EXPECT_FALSE(two_joints(here, there).law(of_length(2)).glued);
}

TEST(ContactProperties, GlueIsInfinitelyStrongOnceItIsClosed) {
  JointStrength glue;
  glue.glued = true;
  ContactRecord contact = of_length(1);
  EXPECT_TRUE(std::isinf(two_joints(glue, {}).law(contact).cohesion));
  EXPECT_TRUE(std::isinf(two_joints(glue, {}).law(contact).tension));
  contact.history.state = ContactState::open;
  EXPECT_EQ(two_joints(glue, {}).law(contact).cohesion, 0);
  EXPECT_FALSE(two_joints(glue, {}).law(contact).glued);
}

TEST(ContactProperties, WithoutABondFrictionIsTheResidualOne) {
  JointStrength joint{0.6};
  ContactRecord contact = of_length(1);
  contact.history.bonded = false;
  EXPECT_EQ(two_joints(joint, {}).law(contact).friction, 0.6);
  joint.residual_friction = 0.2;
  EXPECT_EQ(two_joints(joint, {}).law(contact).friction, 0.2);
  contact.history.bonded = true;
  EXPECT_EQ(two_joints(joint, {}).law(contact).friction, 0.6);
}

/// Crushed over the length that bears the force at the strength, its middle half as far from the vertex.
TEST(ContactProperties, InsetIsHalfOfTheCrushedLengthWithinTheContact) {
  JointStrength joint;
  ContactRecord contact = of_length(0.2);
  contact.history.normal = 5e4;
  EXPECT_EQ(two_joints(joint, {}).inset(contact), 0);
  joint.compressive_strength = 1e6;
  EXPECT_DOUBLE_EQ(two_joints(joint, {}).inset(contact), 0.025);
  contact.history.normal = 1e6;
  EXPECT_DOUBLE_EQ(two_joints(joint, {}).inset(contact), 0.2);
  contact.history.normal = -1;
  EXPECT_EQ(two_joints(joint, {}).inset(contact), 0);
}

TEST(ContactProperties, ForcesPressTheVertexOutAndBalance) {
  Scene scene = rock_scene(0.1, 1);
  scene.blocks = {block(rectangle(1, 0, 2, 1)), block(rectangle(0, -1, 6, 1))};
  const BuiltScene built = build(scene);
  const BlockSystem& blocks = built.stepper->blocks();
  ContactRecord contact = of_length(1);
  contact.normal = 3e4;
  contact.shear = -1e4;
  contact.history.lock = 5. / 6;
  VectorXd F = VectorXd::Zero(blocks.n_unknowns());
  two_joints({}, {}).add_forces(blocks, built.stepper->state(), contact, F);
  const Range& above = blocks.block(0).unknowns();
  EXPECT_LE((F.segment<2>(above.first) - Vec2(1e4, 3e4)).norm(), 1e-8) << "the edge runs to the left";
  Vec3 sum = Vec3::Zero();
  for (const int b : {0, 1}) {
    const Block& of = blocks.block(b);
    const Vec3 on =
        of.rigid_modes(built.stepper->state()).transpose() * F.segment(of.unknowns().first, of.n_unknowns());
    sum += on + Vec3(0, 0, cross(of.centroid(built.stepper->state()), on.head<2>()));
  }
  EXPECT_LE(sum.norm(), 1e-8);
}
