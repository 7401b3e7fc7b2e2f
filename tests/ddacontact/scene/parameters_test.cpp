// [parameters]: numbers called by their name.
#include "example_scenes.hpp"

namespace {

using namespace example_scenes;

const std::string start = R"(format = 1
[parameters]
h = "2 m"
phi = 30
n = 35
[analysis]
steps = "$n"
time_step = 0.02
[[material]]
name = "rock"
density = 2500.0
young = 35e6
poisson = 0.3
[[joint]]
friction_angle = "$phi"
[[block]]
material = "rock"
fixed = ["$zero"]
vertices = [[0, 0], ["$h", 0], ["$h", "$h"]]
)";

std::string with(const std::string& from, const std::string& to) {
  std::string text = start;
  text.replace(text.find("fixed = [\"$zero\"]\n"), 18, "");
  if (!from.empty()) text.replace(text.find(from), from.size(), to);
  return text;
}

TEST(Parameters, ThatNothingUsesAreWarnedOf) {
  EXPECT_TRUE(read(with("", "")).problems.empty());
  const SceneReading reading = read(with("n = 35\n", "n = 35\nmu = 0.5\n"));
  ASSERT_EQ(reading.problems.size(), 1u);
  EXPECT_EQ(reading.problems[0].severity, Problem::Severity::warning);
  EXPECT_EQ(reading.problems[0].line, 6);
  EXPECT_NE(reading.problems[0].text().find("the parameter 'mu' is not used"), std::string::npos);
}

TEST(Parameters, StandForNumbersWithAndWithoutUnits) {
  const Scene scene = scene_of(with("", ""));
  EXPECT_EQ(scene.analysis.steps, 35);
  EXPECT_EQ(scene.joints[0].friction_angle, 30);
  EXPECT_EQ(scene.blocks[0].vertices(0, 1), 2);
  EXPECT_EQ(scene.blocks[0].vertices(1, 2), 2);
}

TEST(Parameters, AreSetFromOutside) {
  EXPECT_EQ(scene_of(with("", ""), {"parameters.h=3"}).blocks[0].vertices(0, 1), 3);
  EXPECT_EQ(scene_of(with("", ""), {"parameters.h=50 cm"}).blocks[0].vertices(0, 1), 0.5);
  EXPECT_EQ(scene_of(with("", ""), {"parameters.n=12"}).analysis.steps, 12);
}

struct Wrong {
  const char *from, *to, *setting;
  int line, column;
  std::vector<const char*> words;
};

TEST(Parameters, WrongOnesAreToldAtTheirPlace) {
  const Wrong cases[] = {
      {"\"$phi\"", "\"$phy\"", "", 15, 18, {"'$phy'", "did you mean 'phi'?"}},
      {"steps = \"$n\"", "steps = \"$m\"", "", 7, 9, {"'$m'", "unknown parameter"}},
      {"young = ", "young = \"$e\" #", "", 12, 9, {"'$e'", "unknown parameter"}},
      {"30", "true", "", 4, 7, {"'phi'", "a number"}},
      {"30", "\"thirty\"", "", 4, 7, {"'phi'", "a number"}},
      {"30", "95", "", 15, 18, {"'$phi = 95'", "out of range"}},
      {"30", "\"2 m\"", "", 15, 18, {"'$phi = 2 m'", "wrong unit"}},
      {"n = 35", "n = 3.5", "", 7, 9, {"'steps'", "whole number"}},
      {"", "", "parameters.hh=3", 1, 1, {"'hh'", "did you mean 'h'?"}},
  };
  for (const Wrong& c : cases) {
    std::vector<std::string> settings;
    if (*c.setting != '\0') settings.emplace_back(c.setting);
    const SceneReading reading = read(with(c.from, c.to), settings);
    ASSERT_EQ(reading.problems.size(), 1u) << c.to << "\n" << reading.problems[1].text();
    EXPECT_EQ(reading.problems[0].line, c.line) << reading.problems[0].text();
    EXPECT_EQ(reading.problems[0].column, c.column) << reading.problems[0].text();
    for (const char* word : c.words)
      EXPECT_NE(reading.problems[0].text().find(word), std::string::npos) << reading.problems[0].text();
  }
}

TEST(Parameters, NamesAndTitlesMayBeginLikeOne) {
  EXPECT_EQ(scene_of(with("format = 1", "format = 1\ntitle = \"$h\"")).title, "$h");
}

}  // namespace
