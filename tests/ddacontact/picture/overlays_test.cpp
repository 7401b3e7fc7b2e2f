// What goes on top of blocks: the line of thrust, the water table.

#include "frames.hpp"

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

}  // namespace
