// What is noted of a scene that is good but rarely meant as it is.
#include "example_scenes.hpp"

#include <ddacontact/scene/builder.hpp>

#include <algorithm>

namespace {

using namespace example_scenes;

/// A slice on a plane of 40 degrees, one on the floor before it; the joint between them ends at `toe`.
std::string two_slices(double toe) {
  const std::string at = std::to_string(toe);
  return R"(format = 1
[analysis]
steps = 1
time_step = 0.01
block_model = "affine"
[[material]]
name = "rock"
density = 2500
young = "20 GPa"
poisson = 0.2
[[joint]]
friction_angle = 20
[[block]]
material = "rock"
vertices = [[-20, -3], [10, -3], [10, 8.391], [0, 0], [-20, 0]]
fixed = true
[[block]]
name = "upper"
material = "rock"
vertices = [[0, 0], [3.0642, 2.57117], [3.0642, 4.57117], [0, 2]]
[[block]]
name = "lower"
material = "rock"
vertices = [[-3, 0], [)" +
         at + ", 0], [" + at + ", 2], [-3, 2]]\n";
}

bool notes(const std::string& text, std::string_view words) {
  const auto built = ddacontact::build(scene_of(text));
  return std::ranges::any_of(built.notes,
                             [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

TEST(BuilderNotes, AJointThatEndsWhereTheFaceBelowItBends) {
  const std::string_view bend =
      "block \"upper\" and block \"lower\" ends where the face of block \"0\" bends";
  EXPECT_TRUE(notes(two_slices(0), bend));
  EXPECT_FALSE(notes(two_slices(-0.1), bend));
}

/// A wedge on a plane of 35 degrees whose foot is at ground that falls by `fall` over 10 m.
std::string wedge_at_ground(double fall, const std::string& foot) {
  return "format = 1\n[analysis]\nsteps = 1\ntime_step = 0.01\n[[material]]\nname = \"rock\"\ndensity = "
         "2600\nyoung = 1e10\n"
         "poisson = 0.2\n[[joint]]\nfriction_angle = 30\n[[block]]\nmaterial = \"rock\"\nvertices = [[-10, "
         "-20], "
         "[30, -20], [30, 7.0021], [10, 7.0021], [0, 0], [-10, " +
         std::to_string(-fall) +
         "]]\nfixed = true\n[[block]]\nname = \"wedge\"\nmaterial = \"rock\"\nvertices = [[0, 0], [10, "
         "7.0021], " +
         foot + "]\n";
}

TEST(BuilderNotes, AFootAtTheGroundBelowASlidingBody) {
  const std::string_view bend = "block \"wedge\" ends where the face of block \"0\" bends";
  EXPECT_TRUE(notes(wedge_at_ground(0, "[3, 7]"), bend));
  EXPECT_FALSE(notes(wedge_at_ground(8, "[3, 7]"), bend)) << "the ground falls away";
  EXPECT_FALSE(notes(wedge_at_ground(0, "[3, 7], [-5, 5], [-10, 0]"), bend)) << "it fills the bend";
  EXPECT_FALSE(notes(
      replaced(wedge_at_ground(0, "[3, 7]"), "[0, 0], [10, 7.0021], [3, 7]", "[-2, 0], [0, 0], [-2, 2]"),
      bend))
      << "it lies on the ground";
  const auto ends_at = [&](const std::string& foot) {
    return replaced(wedge_at_ground(0, "[3, 7]"), "[0, 0], [10, 7.0021], [3, 7]",
                    foot + ", [10, 7.0021], [3, 7]");
  };
  EXPECT_TRUE(notes(ends_at("[0.1, 0.070021]"), "block \"wedge\" ends just before where the face"));
  EXPECT_FALSE(notes(ends_at("[1, 0.70021]"), "where the face of block")) << "it counts as moving before";
  EXPECT_FALSE(notes(ends_at("[0.1, 0.17]"), "where the face of block")) << "it is above the face";
  const std::string ground = "[0, 0], [-10, -0.000000]]\nfixed = true\n";
  EXPECT_TRUE(notes(replaced(replaced(wedge_at_ground(0, "[3, 7]"), "[-10, -20], ", "[0, -20], "), ground,
                             "[0, 0]]\nfixed = true\n[[block]]\nname = \"ground\"\nmaterial = \"rock\"\n"
                             "vertices = [[-10, -20], [0, -20], [0, 0], [-10, 0]]\nfixed = true\n"),
                    "block \"wedge\" ends at the bend between the faces of blocks \"0\" and \"ground\""));
}

TEST(BuilderNotes, FrictionAsACoefficientAndBoltsOfSquareMetres) {
  EXPECT_FALSE(notes(two_slices(0), "as a coefficient"));
  const std::string friction = replaced(two_slices(0), "friction_angle = 20", "friction_angle = 1");
  EXPECT_TRUE(notes(friction, "joint \"0\" is 1 degrees (as a coefficient of friction it would be 45)"));
  EXPECT_FALSE(notes(replaced(two_slices(0), "friction_angle = 20", "friction_angle = 0"), "coefficient"));
  const auto bolted = [](const std::string& area) {
    return two_slices(0) +
           "[[bolt]]\nname = \"bar\"\npoints = [[1, 2], [1, -2]]\nyoung = 2e11\narea = " + area + "\n";
  };
  EXPECT_TRUE(notes(bolted("4"), "bolt \"bar\" has a section of 4 m2"));
  EXPECT_FALSE(notes(bolted("\"4 cm2\""), "section of"));
}

TEST(BuilderNotes, ScenesWithoutJointsOrSupports) {
  const std::string joint = "[[joint]]\nfriction_angle = 20\n";
  EXPECT_FALSE(notes(two_slices(0), "frictionless"));
  EXPECT_TRUE(notes(replaced(two_slices(0), joint, ""), "frictionless"));
  EXPECT_FALSE(notes(replaced(two_slices(0), joint, "[[joint]]\nname = \"default\"\nfriction_angle = 20\n"),
                     "frictionless"));
  EXPECT_FALSE(notes(two_slices(0), "nothing is held"));
  EXPECT_TRUE(notes(replaced(two_slices(0), "fixed = true\n", ""), "nothing is held"));
}

TEST(BuilderNotes, VelocitiesThatStaticStepsForget) {
  const std::string moving =
      replaced(two_slices(0), "name = \"upper\"\n", "name = \"upper\"\nvelocity = [1, 0]\n");
  EXPECT_FALSE(notes(moving, "initial velocity"));
  EXPECT_TRUE(notes(replaced(moving, "steps = 1\n", "steps = 1\nmode = \"static\"\n"),
                    "block \"upper\" starts with static steps"));
}

TEST(BuilderNotes, BondsOfBlocksThatAreNotMeshed) {
  const std::string bonded =
      replaced(two_slices(0), "friction_angle = 20\n", "friction_angle = 20\ntensile_strength = 1e5\n");
  EXPECT_TRUE(notes(bonded, "the tensile strength of joint"));
  EXPECT_FALSE(notes(two_slices(0), "the tensile strength of joint"));
}

}  // namespace
