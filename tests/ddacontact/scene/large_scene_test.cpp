#include "example_scenes.hpp"

#include <chrono>
#include <sstream>

namespace {

using namespace example_scenes;

/// A wall of n x n unit squares.
std::string wall(int n, const char* keys = "") {
  std::ostringstream text;
  text << minimal.substr(0, minimal.find("[[block]]"));
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column)
      text << "[[block]]\nmaterial = \"rock\"\nvertices = [[" << column << ", " << row << "], [" << column + 1
           << ", " << row << "], [" << column + 1 << ", " << row + 1 << "], [" << column << ", " << row + 1
           << "]]\n"
           << keys;
  return text.str();
}

double seconds(const std::string& text) {
  const auto start = std::chrono::steady_clock::now();
  read(text);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TEST(LargeScene, IsReadInTimeLinearInItsSize) {
  EXPECT_EQ(scene_of(wall(60)).blocks.size(), 3600u);
  EXPECT_LT(seconds(wall(120)), 10 * 4 * seconds(wall(60)));
}

TEST(LargeScene, WithAProblemInEachBlockNamesAllOfThem) {
  const SceneReading reading = read(wall(60, "modle = 1\n"));
  EXPECT_EQ(reading.problems.size(), 3600u);
}

TEST(LargeScene, OfBlocksOnTopOfEachOtherIsGivenUp) {
  std::string text(minimal.substr(0, minimal.find("[[block]]")));
  for (int i = 0; i < 5000; ++i) text += minimal.substr(minimal.find("[[block]]"));
  const SceneReading reading = read(text);
  EXPECT_EQ(reading.problems.size(), 1001u);
  EXPECT_NE(all_text(reading.problems).find("more overlapping blocks follow"), std::string::npos);
}

TEST(LargeScene, DeeplyNestedTextIsRefused) {
  const auto repeated = [](const char* part, int times) {
    std::string text;
    for (int i = 0; i < times; ++i) text += part;
    return text;
  };
  const int n = 200000;
  for (const std::string& text :
       {"[" + repeated("a.", n) + "a]\n", repeated("a.", n) + "a = 1\n", repeated("a . ", n) + "a = 1\n",
        repeated("\"a\".", n) + "a = 1\n", "a = " + repeated("[", n) + repeated("]", n),
        "a = " + repeated("{a = ", n), "a = '''x''''\n" + repeated("a.", n) + "a = 1\n",
        "a = {" + repeated("a.", n) + "a = 1}\n"}) {
    const SceneReading reading = read(text);
    EXPECT_FALSE(reading.scene);
    EXPECT_EQ(reading.problems.size(), 1u);
  }
}

TEST(LargeScene, DotsInStringsAndCommentsAreNoKeys) {
  EXPECT_EQ(scene_of("# ..................................\ntitle = \"...................... ''\" # "
                     "......................\n" +
                     std::string(minimal))
                .title,
            "...................... ''");
}

TEST(LargeScene, ABlockOfTooManyVerticesIsRefused) {
  std::string vertices = "[0, 0]";
  for (int k = 1; k < 5000; ++k) vertices += ", [" + std::to_string(k) + ", " + std::to_string(k % 7) + "]";
  const SceneReading reading = read(replaced(minimal, "[0, 0], [1, 0], [1, 1], [0, 1]", vertices));
  ASSERT_EQ(reading.problems.size(), 1u);
  EXPECT_NE(reading.problems[0].text().find("5000 vertices"), std::string::npos);
}

}  // namespace
