// What the program says of whether its answer is an equilibrium.
#include "program.hpp"

#include <cmath>

namespace {

using namespace support;

/// A block on a slope of 45 degrees: it stays where friction is more than that.
std::string slope_scene(const std::string& mode, double friction_angle, const std::string& stages) {
  return R"(format = 1
[analysis]
time_step = 0.01
steps = 10
mode = ")" +
         mode + R"("
[[material]]
name = "rock"
density = 2500
young = "35 GPa"
poisson = 0.3
[[joint]]
name = "interface"
friction_angle = )" +
         std::to_string(friction_angle) + R"(
[[block]]
name = "ramp"
material = "rock"
vertices = [[0, 0], [12, 0], [0, 12]]
fixed = true
[[block]]
name = "slider"
material = "rock"
vertices = [[3, 9], [5, 7], [6, 8], [4, 10]]
)" + stages;
}

const char settle_until[] = R"([[stage]]
name = "settle"
mode = "static"
steps = 400
until = { kinetic = 1e-8, displacement = 1e-6 }
joints = { interface = { friction_angle = 80 } }
[[stage]]
name = "slide"
mode = "dynamic"
steps = 7
)";

class Verdict : public Program {
 protected:
  bool says(const std::string& text) const { return err_.find(text) != std::string::npos; }
};

TEST_F(Verdict, AStaticRunThatSlidesIsNoEquilibriumAndSaysSo) {
  write("slope.toml", slope_scene("static", 30, ""));
  EXPECT_EQ(dda("run slope.toml --quiet"), 0);
  EXPECT_TRUE(says("slope.toml: warning: this is no equilibrium")) << err_;
  EXPECT_TRUE(says("block \"slider\" is out of balance by 0.3 of")) << err_;
  const nlohmann::json json = summary("slope-out");
  EXPECT_EQ(json["status"], "completed");
  EXPECT_NEAR(json["unbalanced"].get<double>(), std::sqrt(0.5) * (1 - std::tan(std::acos(-1) / 6)), 1e-5);
  EXPECT_EQ(json["unbalanced_block"], "slider");
  EXPECT_EQ(json["at_rest"], false);
  EXPECT_GT(json["fastest"].get<double>(), 0);
  EXPECT_EQ(json["fastest_block"], "slider");
  EXPECT_EQ(json["warnings"].size(), 1u);
  EXPECT_EQ(dda("info slope-out"), 0);
  for (const char* words : {"not at rest", "1 block is out of balance; most block slider, by 0.3",
                            "block slider moves fastest", "this is no equilibrium"})
    EXPECT_NE(out_.find(words), std::string::npos) << words << " in\n" << out_;
}

TEST_F(Verdict, AStaticRunThatStandsIsAtRest) {
  write("slope.toml", slope_scene("static", 50, ""));
  EXPECT_EQ(dda("run slope.toml --quiet"), 0);
  EXPECT_EQ(err_, "");
  EXPECT_EQ(summary("slope-out")["at_rest"], true);
  EXPECT_LE(summary("slope-out")["unbalanced"].get<double>(), 1e-6);
  EXPECT_EQ(dda("info slope-out"), 0);
  EXPECT_NE(out_.find("at rest: all blocks are in balance"), std::string::npos) << out_;
}

TEST_F(Verdict, UntilEndsAStageAndResumedRunsEndItWithTheSameStep) {
  write("slope.toml", slope_scene("static", 30, settle_until));
  ASSERT_EQ(dda("run slope.toml --quiet -o whole"), 0) << err_;
  const nlohmann::json json = summary("whole");
  const long settled = json["stages"][0]["steps"];
  EXPECT_TRUE(json["stages"][0]["came_to_rest"].get<bool>());
  EXPECT_GT(settled, 1);
  EXPECT_LT(settled, 400);
  EXPECT_EQ(json["stages"][1]["steps"], 7);
  EXPECT_EQ(json["steps_completed"], settled + 7);
  for (long steps : {settled - 1, settled, settled + 1}) {
    ASSERT_EQ(dda("run slope.toml --quiet -o part --steps " + std::to_string(steps)), 0);
    EXPECT_EQ(summary("part")["steps_completed"], steps);
    ASSERT_EQ(dda("run slope.toml --quiet -o resumed --resume part/checkpoint.bin"), 0) << err_;
    for (const char* file : {"checkpoint.bin", "energy.csv", "blocks.csv", "contacts.csv"})
      EXPECT_TRUE(read_file(directory_ / "whole" / file) == read_file(directory_ / "resumed" / file)) << file;
    EXPECT_EQ(summary("resumed")["stages"], json["stages"]);
  }
}

TEST_F(Verdict, UntilThatNeverComesTrueIsWarnedOf) {
  std::string text = slope_scene("static", 30, settle_until);
  text.replace(text.find("friction_angle = 80"), 19, "friction_angle = 20");
  write("slope.toml", text);
  EXPECT_EQ(dda("run slope.toml --quiet --set stage.settle.steps=3"), 0);
  EXPECT_TRUE(
      says("slope.toml: warning: stage \"settle\" made all its 3 steps and its 'until' never came true"))
      << err_;
  EXPECT_EQ(summary("slope-out")["stages"][0]["at_rest"], false);
}

/// Steps far shorter than their use, on a slope whose static stages have not settled: corners that pass steps in
/// joints are not thrown over them.
TEST_F(Verdict, ShortStepsPushNoPenetrationOut) {
  ASSERT_EQ(dda("make joints --spacing 6 -o joints.toml"), 0) << err_;
  for (const char* time_step : {"1e-6", "1e-4"}) {
    dda("run joints.toml --quiet --force --set stage.0.steps=15 --set stage.1.steps=15 --set stage.2.steps=4"
        " --set stage.2.time_step=" +
        std::string(time_step));
    const nlohmann::json energy = summary("joints-out")["energy"];
    EXPECT_LT(energy["pushed_out"].get<double>(), 0.01 * std::abs(energy["gravity"].get<double>()))
        << time_step;
  }
}

}  // namespace
