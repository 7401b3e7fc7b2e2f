/// \file A static analysis wants every block held, by its vertices or by what it rests on.
#include "example_scenes.hpp"

#include <algorithm>

namespace {

using namespace example_scenes;

/// A floor 8 m wide with its top at y = 0, held at two vertices, then blocks of 1 m x 1 m whose lower left
/// corners are given.
std::string scene_with(const std::vector<std::string>& boxes, const std::string& gravity = "[0, -9.8]") {
  std::string text = "[analysis]\nmode = \"static\"\nsteps = 1\ntime_step = 0.01\ngravity = " + gravity +
                     "\n[[material]]\nname = \"rock\"\ndensity = 2500\nyoung = 1e9\npoisson = 0.25\n"
                     "[[block]]\nmaterial = \"rock\"\nvertices = [[0, -1], [8, -1], [8, 0], [0, 0]]\n"
                     "fixed = [0, 1]\n";
  for (const std::string& corner : boxes) {
    const double x = std::stod(corner), y = std::stod(corner.substr(corner.find(',') + 1));
    text += "[[block]]\nmaterial = \"rock\"\nvertices = [";
    for (const auto& [dx, dy] : {std::pair{0, 0}, std::pair{1, 0}, std::pair{1, 1}, std::pair{0, 1}})
      text += "[" + std::to_string(x + dx) + ", " + std::to_string(y + dy) + "], ";
    text += "]\n";
  }
  return text;
}

/// The indices of the refused blocks.
std::vector<int> loose_blocks(const std::string& text, const std::vector<std::string>& settings = {}) {
  std::vector<int> loose;
  for (const Problem& problem : read(text, settings).problems) {
    EXPECT_NE(problem.what.find("is free and nothing can hold it"), std::string::npos) << problem.text();
    loose.push_back(std::stoi(problem.what.substr(std::string("block ").size())));
  }
  return loose;
}

using Blocks = std::vector<int>;

TEST(StaticCheck, NamesTheBlockItsPlaceAndTheCure) {
  const SceneReading reading = read(replaced(minimal, "steps = 1", "steps = 1\nmode = \"static\""));
  ASSERT_EQ(reading.problems.size(), 1u);
  EXPECT_EQ(reading.problems[0].text(),
            "scene.toml:12:12: error: block 0 is free and nothing can hold it in a static analysis (hold a "
            "vertex, or let it rest on something held, or use mode = \"dynamic\")");
}

TEST(StaticCheck, ADynamicAnalysisNeedsNoHold) {
  EXPECT_TRUE(read(minimal).scene);
  EXPECT_EQ(loose_blocks(scene_with({"20, 20"}), {"analysis.mode=dynamic"}), Blocks{});
}

TEST(StaticCheck, OneFixedVertexWillDo) {
  const std::string text = replaced(minimal, "steps = 1", "steps = 1\nmode = \"static\"");
  EXPECT_TRUE(read(text, {"block.0.fixed=[2]"}).scene);
  EXPECT_TRUE(read(text + "[[support]]\nblock = 0\nvertices = [0]\naxes = \"x\"\n").scene);
}

TEST(StaticCheck, WhatTouchesSomethingHeldIsHeldThroughOthers) {
  // A cantilever of blocks that stick out beyond the floor, the last one beneath it.
  EXPECT_EQ(loose_blocks(scene_with({"7.5, 0", "8.4, 1", "9.3, 0", "9.3, -1"})), Blocks{});
  // Nearly: a gap of 1e-2 of the size is bridged, a larger one sideways is not.
  EXPECT_EQ(loose_blocks(scene_with({"8.009, -1"})), Blocks{});
  EXPECT_EQ(loose_blocks(scene_with({"8.011, -1"})), Blocks{1});
}

TEST(StaticCheck, WhatFallsOntoSomethingHeldIsHeld) {
  EXPECT_EQ(loose_blocks(scene_with({"3, 5"})), Blocks{});
  EXPECT_EQ(loose_blocks(scene_with({"7.5, 5", "8.2, 9", "8.9, 12"})), Blocks{});
  EXPECT_EQ(loose_blocks(scene_with({"8.9, 12", "8.2, 9", "7.5, 5"})), Blocks{}) << "in any order";
  EXPECT_EQ(loose_blocks(scene_with({"8.2, 9"})), Blocks{1}) << "past its end";
  EXPECT_EQ(loose_blocks(scene_with({"3, -5"})), Blocks{1}) << "hanging in the air below";
}

TEST(StaticCheck, WhatStandsInANotchIsHeldAndWhatHangsThereIsNot) {
  const auto with_trough = [](const std::string& corner) {
    return replaced(scene_with({corner}, "[0, 0]"), "[8, -1], [8, 0], [0, 0]]",
                    "[8, -1], [8, 3], [6, 3], [6, 0], [2, 0], [2, 3], [0, 3]]");
  };
  EXPECT_EQ(loose_blocks(with_trough("3, 0")), Blocks{});
  EXPECT_EQ(loose_blocks(with_trough("2.005, 1.5")), Blocks{});
  EXPECT_EQ(loose_blocks(with_trough("3.5, 1")), Blocks{1});
}

TEST(StaticCheck, OneErrorForEachLooseBlock) {
  EXPECT_EQ(loose_blocks(scene_with({"20, 0", "3, 0", "20, 1", "-5, 0"})), (Blocks{1, 3, 4}));
}

TEST(StaticCheck, OneErrorForBlocksOfOnePlaceOfTheFile) {
  const SceneReading reading = read(
      replaced(scene_with({"20, 0"}), "[[block]]\nmaterial = \"rock\"\nvertices = [[20",
               "[[block]]\nmaterial = \"rock\"\ngrid = { count = [3, 2], step = [2, 2] }\nvertices = [[20"));
  ASSERT_EQ(reading.problems.size(), 1u) << all_text(reading.problems);
  EXPECT_NE(reading.problems[0].what.find("and 5 more are free and nothing can hold them"), std::string::npos)
      << reading.problems[0].text();
}

TEST(StaticCheck, FallsAlongGravityWhereverThisPoints) {
  EXPECT_EQ(loose_blocks(scene_with({"3, -9"}, "[1, 9.8]")), Blocks{}) << "upwards";
  EXPECT_EQ(loose_blocks(scene_with({"11, -0.5"}, "[-1, 0]")), Blocks{}) << "sideways";
  EXPECT_EQ(loose_blocks(scene_with({"-9, -0.5"}, "[-1, 0]")), Blocks{1}) << "away";
  EXPECT_EQ(loose_blocks(scene_with({"14, 8"}, "[-1, -1]")), Blocks{}) << "aslant";
  EXPECT_EQ(loose_blocks(scene_with({"3, 5"}, "[0, 0]")), Blocks{1}) << "nothing falls";
}

/// `stages` one after the other; block 1 is a pillar on the floor, 2 a box on it beyond the floor's end.
std::string staged(const std::string& stages) {
  return replaced(scene_with({"7.5, 0", "8.2, 1"}), "mode = \"static\"\nsteps = 1\n", "") + stages;
}
const std::string at_rest = "[[stage]]\nmode = \"static\"\nsteps = 1\n", in_motion = "[[stage]]\nsteps = 1\n",
                  without_pillar = "remove = [1]\n";

TEST(StaticCheck, LooksAtEveryStaticStageWithTheBlocksThatAreThere) {
  EXPECT_EQ(loose_blocks(staged(at_rest + at_rest)), Blocks{});
  EXPECT_EQ(loose_blocks(staged(at_rest + at_rest + without_pillar)), Blocks{2});
  EXPECT_EQ(loose_blocks(staged(at_rest + without_pillar + at_rest + at_rest)), Blocks{2}) << "said once";
  EXPECT_EQ(loose_blocks(staged(at_rest + "remove = [1, 2]\n")), Blocks{});
  EXPECT_EQ(loose_blocks(staged(at_rest + "remove = [0]\n")), (Blocks{1, 2})) << "the floor";
  EXPECT_EQ(loose_blocks(staged(at_rest + in_motion + without_pillar)), Blocks{}) << "it may fall";
  EXPECT_EQ(loose_blocks(staged(in_motion), {"analysis.mode=static", "stage.0.remove=[1]"}), Blocks{2});
  EXPECT_EQ(
      loose_blocks(staged(in_motion), {"analysis.mode=static", "stage.0.mode=dynamic", "stage.0.remove=[1]"}),
      Blocks{});
}

TEST(StaticCheck, NamesTheStage) {
  const SceneReading reading = read(staged(at_rest + at_rest + without_pillar), {"stage.1.name=dig"});
  ASSERT_EQ(reading.problems.size(), 1u) << all_text(reading.problems);
  EXPECT_NE(reading.problems[0].what.find("in stage 'dig', which is static"), std::string::npos);
  EXPECT_EQ(reading.problems[0].severity, Problem::Severity::error);
}

TEST(StaticCheck, OnlyWarnsOfBlocksThatMayHaveMoved) {
  const SceneReading reading = read(staged(in_motion + at_rest + without_pillar));
  EXPECT_TRUE(reading.scene);
  ASSERT_EQ(reading.problems.size(), 1u) << all_text(reading.problems);
  EXPECT_EQ(reading.problems[0].severity, Problem::Severity::warning);
  EXPECT_NE(reading.problems[0].what.find("in stage 1, which is static, unless it has moved"),
            std::string::npos);
}

TEST(StaticCheck, WhatHasFallenInAStaticStageLiesThere) {
  const std::string up_there = replaced(scene_with({"3, 5"}), "mode = \"static\"\nsteps = 1\n", "") + at_rest;
  EXPECT_EQ(loose_blocks(up_there + at_rest + "gravity = [1.0, 0.0]\n"), Blocks{});
  EXPECT_EQ(loose_blocks(up_there, {"stage.0.gravity=[1.0, 0.0]"}), Blocks{1});
}

TEST(StaticCheck, WaitsUntilTheHoldsAreInNoDoubt) {
  const std::string text = scene_with({"20, 0"}) + "[[support]]\nblock = 1\nvertices = [0]\n";
  for (const char* bad :
       {"block.0.fixed=[7, true]", "block.0.fixed=[7]", "block.1.fixed=maybe", "support.0.block=7",
        "support.0.vertices=[4]", "analysis.gravity=0", "block.0.vertices.2=[1, -1]", "blocks=no/wall.wkt"}) {
    const SceneReading reading = read(text, {"support.0.block=0", "support.0.axes=y", bad});
    EXPECT_FALSE(reading.scene);
    for (const Problem& problem : reading.problems)
      EXPECT_EQ(problem.what.find("nothing can hold it"), std::string::npos) << bad << problem.text();
  }
  for (const char* bad : {"stage.0.remove=[7]", "stage.0.remove=1", "stage.0.mode=x", "stage.0.gravity=0"}) {
    const SceneReading reading = read(staged(at_rest + without_pillar), {bad});
    EXPECT_EQ(reading.problems.size(), 1u) << all_text(reading.problems);
  }
  // Other mistakes do not hide it.
  const SceneReading reading = read(text, {"support.0.block=0", "material.rock.poisson=7"});
  EXPECT_EQ(reading.problems.size(), 2u) << all_text(reading.problems);
}

TEST(StaticCheck, ManyLooseBlocksAreListedToAnEnd) {
  std::vector<std::string> boxes;
  for (int i = 0; i < 1200; ++i) boxes.push_back(std::to_string(20 + 2 * i) + ", 0");
  const SceneReading reading = read(scene_with(boxes));
  ASSERT_EQ(reading.problems.size(), 1001u);
  EXPECT_NE(reading.problems.back().text().find("more blocks without support follow"), std::string::npos);
}

}  // namespace
