// What goes on top of blocks: the line of thrust, the water table, contact forces; and where stress is looked
// at.

#include "frames.hpp"

#include <ddacontact/picture/arrows.hpp>
#include <ddacontact/picture/field_layer.hpp>
#include <ddacontact/picture/picture.hpp>
#include <ddacontact/picture/thrust_layer.hpp>
#include <ddacontact/picture/water_layer.hpp>

namespace {

using namespace support;

/// A column of three: the middle one bears on one corner more than on the other.
TEST(Picture, TheLineOfThrustGoesWhereTheResultantsAct) {
  Frame frame = empty_frame();
  for (int k = 0; k < 3; ++k) add_block(frame, box(0, k, 1, 1), Mat2::Zero());
  const auto press = [&](int upper, double x, double force) {
    frame.contacts.push_back({.vertex_block = upper,
                              .edge_block = upper - 1,
                              .position = Vec2(x, upper),
                              .normal = Vec2(0, 1),
                              .normal_force = force,
                              .state = ContactState::stick});
  };
  press(1, 0, 1e3);
  press(1, 1, 3e3);
  press(2, 0, 2e3);
  press(2, 1, 2e3);
  const std::vector<JointResultant> joints = joint_resultants(frame);
  ASSERT_EQ(joints.size(), 2u);
  EXPECT_EQ(joints[0].at, Vec2(0.75, 1));
  EXPECT_EQ(joints[0].force, Vec2(0, -4e3));
  const auto line = line_of_thrust(frame);
  ASSERT_EQ(line.size(), 1u);
  EXPECT_EQ(line[0].first, Vec2(0.75, 1));
  EXPECT_EQ(line[0].second, Vec2(0.5, 2));
  PictureOptions options;
  EXPECT_EQ(texts(parsed(draw({{.frame = &frame}}, options))).find("line of thrust"), std::string::npos);
  options.thrust = true;
  EXPECT_NE(texts(parsed(draw({{.frame = &frame}}, options))).find("line of thrust"), std::string::npos);
}

/// A table above the blocks is drawn, one below all of them is not.
TEST(Picture, TheWaterTableIsDrawnWhereItIs) {
  Frame frame = empty_frame();
  add_block(frame, box(0, 0, 4, 2), Mat2::Zero());
  Panel panel{.frame = &frame};
  panel.water.table = (Points(2, 2) << 1, 3, 1.5, 3).finished();
  panel.water.joint_table = panel.water.table;
  std::string told = texts(parsed(draw({panel}, {})));
  EXPECT_NE(told.find("water table\n"), std::string::npos) << told;
  EXPECT_EQ(told.find("water table of joints"), std::string::npos) << told;
  panel.water.joint_table = (Points(2, 1) << 0, 1).finished();
  told = texts(parsed(draw({panel}, {})));
  EXPECT_NE(told.find("water table of joints"), std::string::npos) << told;
  const Window about = with_water({{0, 0}, {4, 2}}, panel.water);
  EXPECT_EQ(about.low, Vec2(0, 0));
  EXPECT_EQ(about.high, Vec2(4, 3));
  panel.water.table = panel.water.joint_table = (Points(2, 1) << 0, -10).finished();
  told = texts(parsed(draw({panel}, {})));
  EXPECT_EQ(told.find("water"), std::string::npos) << told;
}

TEST(Picture, ContactForcesActOnTheSameBlockWhicheverHasTheVertex) {
  Frame frame = empty_frame();  // side by side and as large: it is the right one
  for (int k = 0; k < 2; ++k) add_block(frame, box(0.5 * k, 0, 0.5, 1), Mat2::Zero());
  frame.contacts.push_back({1, 0, Vec2(0.5, 0.5), {1, 0}, 0, 30e3, 40e3, ContactState::stick});
  frame.contacts.push_back({0, 1, Vec2(0.5, 0.2), {-1, 0}, 0, 30e3, 40e3, ContactState::stick});
  const std::vector<Arrow> arrows = arrows_of(frame, VectorKind::contact_forces);
  EXPECT_EQ(arrows[0].vector, arrows[1].vector);
  EXPECT_EQ(arrows[0].vector, Vec2(30e3, 40e3));
}

/// A bin: its walls, taller than what they hold and upright, press on it from both sides, its floor from
/// below.
TEST(Picture, ContactForcesOfWallsActOnWhatTheyHold) {
  Frame frame = empty_frame();
  add_block(frame, box(0, 0, 1, 1), Mat2::Zero());
  add_block(frame, box(-1, 0, 1, 9), Mat2::Zero());
  add_block(frame, box(1, 0, 1, 9), Mat2::Zero());
  add_block(frame, box(-1, -1, 3, 1), Mat2::Zero());
  frame.contacts.push_back({0, 1, Vec2(0, 0.5), {1, 0}, 0, 10, 0, ContactState::stick});
  frame.contacts.push_back({2, 0, Vec2(1, 0.5), {1, 0}, 0, 10, 0, ContactState::stick});
  frame.contacts.push_back({0, 3, Vec2(0.5, 0), {0, 1}, 0, 10, 0, ContactState::stick});
  std::vector<Arrow> arrows = arrows_of(frame, VectorKind::contact_forces);
  EXPECT_EQ(arrows[0].vector, Vec2(10, 0));
  EXPECT_EQ(arrows[1].vector, Vec2(-10, 0));
  EXPECT_EQ(arrows[2].vector, Vec2(0, 10));
  // A roof that has not moved presses down on what has.
  frame.displacement = Points::Zero(2, frame.position.cols());
  frame.displacement.rightCols(4).setOnes();
  arrows = arrows_of(frame, VectorKind::contact_forces);
  EXPECT_EQ(arrows[2].vector, Vec2(0, -10));
}

/// Next to a short edge gradients of the shape functions are large: pictures do not go there.
TEST(Picture, StressIsLookedAtWhereIntegrationPointsAre) {
  Frame frame = empty_frame();
  const Points outline = (Points(2, 5) << 0, 1, 1, 0.999, 0, 0, 0, 1, 1.001, 1).finished();
  add_block(frame, outline, Mat2::Zero());
  Points w = Points::Zero(2, 5);
  w(1, 3) = 1e-5;
  frame.strain_displacement = w;
  const FieldSamples samples(frame, Field::s1, 300);
  const double at_the_short_edge = 1e-5 / 0.0014 * frame.elasticity[0](0, 0);
  EXPECT_LT(samples.range().high, 0.05 * at_the_short_edge);
}

TEST(Picture, StressesOfRoundOffAreNone) {
  Frame frame = empty_frame();
  Mat2 tiny;
  tiny << 1e-15, 0, 0, -1e-15;
  add_block(frame, box(0, 0, 1, 1), tiny);
  const FieldSamples samples(frame, Field::s1, 100);
  EXPECT_EQ(samples.range().low, 0);
  EXPECT_EQ(samples.range().high, 0);
}

}  // namespace
