#include "example_scenes.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace {

using namespace example_scenes;

TEST(Problems, AreWrittenInOneLineWithPlaceAndCure) {
  const Problem problem{Problem::Severity::error, "a.toml", 3, 7, "'x' is wrong", "write y"};
  EXPECT_EQ(problem.text(), "a.toml:3:7: error: 'x' is wrong (write y)");
  const Problem warning{Problem::Severity::warning, "a.toml", 3, 7, "'x' is odd", ""};
  EXPECT_EQ(warning.text(), "a.toml:3:7: warning: 'x' is odd");
  EXPECT_FALSE(ddacontact::has_errors({warning}));
  EXPECT_TRUE(ddacontact::has_errors({warning, problem}));
}

TEST(Problems, OfAFileAreAllNamedInTheOrderOfTheFile) {
  std::string text = replaced(complete, "steps = 35", "steps = 0");
  text = replaced(text, "poisson = 0.2", "poisson = 0.7");
  text = replaced(text, "friction_angle = 30.0", "friction = 30.0");
  text = replaced(text, "material = \"soil\"", "material = \"sol\"");
  text = replaced(text, "[5.0, 2.0], [1.0, 2.0]", "[1.0, 2.0], [5.0, 2.0]");
  text = replaced(text, "block = 2\n", "block = 9\n");
  text = replaced(text, "at = [3.0, 2.0]", "at = [3.0, nan]");
  const SceneReading reading = read(text);
  EXPECT_FALSE(reading.scene);
  std::vector<int> lines;
  for (const Problem& problem : reading.problems) lines.push_back(problem.line);
  EXPECT_EQ(lines, (std::vector<int>{5, 20, 23, 30, 37, 51, 79})) << all_text(reading.problems);
}

TEST(Problems, OfOneValueBringNoOthersAlong) {
  // Each is used further: no complaint about what follows from a value that is wrong itself.
  for (const auto& [from, to] :
       {std::pair{"[[1.0, 0.0], [5.0, 0.0],", "[[1.0, nan], [5.0, 0.0],"},
        std::pair{"gravity = [0.0, -9.8]", "gravity = 0"}, std::pair{"density = 2500.0", "density = -1"},
        std::pair{"[[block]]\nname = \"slider\"", "[[block]]\nname = 3"},
        std::pair{"axes = \"x\"", "axes = \"z\""},
        std::pair{"friction_angle = 30.0", "friction_angle = \"30 m\"\nresidual_friction_angle = 20"},
        std::pair{"[output]",
                  "[water]\ntable = [[0, -2], [8, -2]]\njoints = \"yes\"\n"
                  "joint_table = [[0, -2], [8, -2]]\n[output]"}}) {
    const SceneReading reading = read(replaced(complete, from, to));
    const auto errors = std::count_if(reading.problems.begin(), reading.problems.end(), [](const Problem& p) {
      return p.what.find("unknown block 'slider'") == std::string::npos;
    });
    EXPECT_EQ(errors, 1) << all_text(reading.problems);
  }
}

TEST(Problems, OfATableThatCannotBeReadAreThoseOfItsName) {
  for (const char* material : {"[material]", "[[materials]]"}) {
    const SceneReading reading = read(replaced(minimal, "[[material]]", material));
    ASSERT_EQ(reading.problems.size(), 1u) << all_text(reading.problems);
    EXPECT_NE(reading.problems[0].text().find("[[material]]"), std::string::npos);
  }
}

TEST(Problems, GravityUpwardsIsAWarning) {
  const SceneReading reading = read(replaced(complete, "gravity = [0.0, -9.8]", "gravity = [0.0, 9.8]"));
  ASSERT_TRUE(reading.scene);
  EXPECT_NE(all_text(reading.problems)
                .find("warning: gravity acts upwards (y points upwards: write gravity "
                      "= [0, -9.8])"),
            std::string::npos)
      << all_text(reading.problems);
}

TEST(Problems, OfAnEmptySceneNameWhatItNeeds) {
  for (const char* text : {"", "\n\n", "# only a comment", "\xef\xbb\xbf"}) {
    const SceneReading reading = read(text);
    EXPECT_FALSE(reading.scene);
    EXPECT_FALSE(reading.unreadable);
    ASSERT_EQ(reading.problems.size(), 3u);
    EXPECT_EQ(
        reading.problems[0].text(),
        "scene.toml:1:1: error: the scene has no [analysis] (add [analysis] with 'steps', 'time_step')");
    EXPECT_NE(reading.problems[1].text().find("[[material]]"), std::string::npos);
    EXPECT_NE(reading.problems[2].text().find("[[block]]"), std::string::npos);
  }
}

TEST(Problems, OfAMissingFileSaySo) {
  for (const std::string path : {"no/such/scene.toml", "."}) {
    const SceneReading reading = ddacontact::read_scene(path);
    EXPECT_TRUE(reading.unreadable);
    EXPECT_FALSE(reading.scene);
    ASSERT_EQ(reading.problems.size(), 1u);
    EXPECT_EQ(reading.problems[0].text().find(path + ":1:1: error: '" + path + "' cannot be read"), 0u);
  }
}

TEST(Problems, OfAFileNameIt) {
  const auto path = std::filesystem::path(testing::TempDir()) / "scene_problem_test.toml";
  std::ofstream(path) << replaced(minimal, "steps = 1", "steps = 0");
  const SceneReading reading = ddacontact::read_scene(path.string());
  ASSERT_EQ(reading.problems.size(), 1u);
  EXPECT_EQ(reading.problems[0].file, path.string());
  EXPECT_EQ(reading.problems[0].line, 2);
  std::ofstream(path, std::ios::trunc) << "";
  EXPECT_FALSE(ddacontact::read_scene(path.string()).unreadable);
  std::filesystem::remove(path);
}

TEST(Problems, OfATableInTheWrongNumberSayHowToWriteIt) {
  const SceneReading single = read(replaced(minimal, "[[block]]", "[block]"));
  ASSERT_EQ(single.problems.size(), 1u);
  EXPECT_EQ(single.problems[0].text(),
            "scene.toml:9:1: error: 'block' is a table (write [[block]] for each)");
  const SceneReading value = read("contact = 3\n" + std::string(minimal));
  ASSERT_EQ(value.problems.size(), 1u);
  EXPECT_EQ(value.problems[0].text(),
            "scene.toml:1:11: error: 'contact' is the whole number '3' (write one table [contact])");
  EXPECT_FALSE(read("support = [1]\n" + std::string(minimal)).scene);
}

TEST(Problems, ANameThatIsTheIndexOfANamelessBlockIsAWarning) {
  const SceneReading reading = read(std::string(minimal) + "[[block]]\nname = \"0\"\nmaterial = \"rock\"\n" +
                                    "vertices = [[2, 0], [3, 0], [3, 1], [2, 1]]\n");
  EXPECT_TRUE(reading.scene);
  ASSERT_EQ(reading.problems.size(), 1u);
  EXPECT_EQ(reading.problems[0].severity, Problem::Severity::warning);
}

TEST(Problems, ClockwisePolygonsAreTurnedAroundAndSaidSo) {
  const SceneReading reading = read(replaced(minimal, "[1, 0], [1, 1], [0, 1]", "[0, 1], [1, 1], [1, 0]"));
  ASSERT_TRUE(reading.scene);
  ASSERT_EQ(reading.problems.size(), 1u);
  EXPECT_EQ(reading.problems[0].severity, Problem::Severity::warning);
  EXPECT_NE(reading.problems[0].text().find("clockwise"), std::string::npos);
  // The scene keeps the order of the file.
  EXPECT_EQ(reading.scene->blocks[0].vertices.col(1), ddacontact::Vec2(0, 1));
}

TEST(Problems, SeveralClockwisePolygonsAreOneWarning) {
  std::string text = replaced(minimal, "[1, 0], [1, 1], [0, 1]", "[0, 1], [1, 1], [1, 0]");
  for (const char* vertices : {"[[2, 0], [2, 1], [3, 1]]", "[[4, 0], [4, 1], [5, 1]]"})
    text += "[[block]]\nmaterial = \"rock\"\nvertices = " + std::string(vertices) + "\n";
  const SceneReading reading = read(text);
  ASSERT_TRUE(reading.scene);
  ASSERT_EQ(reading.problems.size(), 1u);
  EXPECT_NE(reading.problems[0].text().find("block 0 and 2 more run clockwise"), std::string::npos);
}

/// A joint of k Pa/m closes under blocks of 2500 kg/m3 by rho g / k of their height.
TEST(Problems, AJointThatBlocksPressShutIsAWarning) {
  const auto warnings = [](const std::string& stiffness) {
    const std::string springs = "normal_stiffness = " + stiffness + "\nshear_stiffness = " + stiffness;
    return all_text(read(replaced(complete, "friction_angle = 30.0", springs)).problems);
  };
  EXPECT_EQ(warnings("3e5").find("closes by"), std::string::npos);
  EXPECT_NE(warnings("5e4").find("joint \"interface\" closes by 49 % of the height"), std::string::npos)
      << warnings("5e4");
}

TEST(Problems, ABlockLostInTheRoundOffOfTheSceneIsRefused) {
  const SceneReading reading =
      read(std::string(minimal) +
           "\n[[block]]\nmaterial = \"rock\"\nvertices = [[-1e16, -1e16], [1e16, -1e16], "
           "[1e16, 0], [-1e16, 0]]\nfixed = true\n");
  EXPECT_FALSE(reading.scene);
  const std::string text = all_text(reading.problems);
  EXPECT_NE(text.find(":11:12: error: block 0 of 1 m is lost in the round-off of a scene of 2.236e+16 m"),
            std::string::npos)
      << text;
}

TEST(Problems, AnUnusedJointIsAWarning) {
  const SceneReading reading = read(replaced(complete, "between = [\"rock\", \"soil\"]\n", ""));
  EXPECT_TRUE(reading.scene);
  ASSERT_EQ(reading.problems.size(), 1u);
  EXPECT_EQ(reading.problems[0].severity, Problem::Severity::warning);
  EXPECT_NE(reading.problems[0].text().find("'weak'"), std::string::npos);
}

}  // namespace
