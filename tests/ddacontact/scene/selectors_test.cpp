// Blocks in groups and grids, and what selectors find of them.
#include "example_scenes.hpp"

#include <ddacontact/scene/writer.hpp>

#include <algorithm>
#include <sstream>

namespace {

using namespace example_scenes;

/// Four bricks of 1 x .5 m on two courses, the upper one shifted by half a brick, on a base.
const std::string wall = R"(format = 1
[analysis]
steps = 3
time_step = 0.01
gravity = [0.0, -10.0]
[[material]]
name = "brick"
density = 2000.0
young = 1e9
poisson = 0.2
[[block]]
name = "brick"
group = ["wall", "masonry"]
material = "brick"
vertices = [[0, 0], [1, 0], [1, 0.5], [0, 0.5]]
grid = { count = [2, 2], step = [1.0, 0.5], bond = 0.5 }
[[block]]
name = "base"
group = "masonry"
material = "brick"
vertices = [[-1, -1], [4, -1], [4, 0], [-1, 0]]
fixed = true
)";

std::vector<int> blocks_held(const Scene& scene) {
  std::vector<int> blocks;
  for (const ddacontact::Support& support : scene.supports) blocks.push_back(support.block);
  return blocks;
}

TEST(Grids, CopyABlockInBond) {
  const Scene scene = scene_of(wall);
  ASSERT_EQ(scene.blocks.size(), 5u);
  const char* names[] = {"brick.0.0", "brick.1.0", "brick.0.1", "brick.1.1", "base"};
  const double x[] = {0, 1, 0.5, 1.5, -1}, y[] = {0, 0, 0.5, 0.5, -1};
  for (int b = 0; b < 5; ++b) {
    EXPECT_EQ(scene.blocks[b].name, names[b]);
    EXPECT_EQ(scene.blocks[b].vertices(0, 0), x[b]);
    EXPECT_EQ(scene.blocks[b].vertices(1, 0), y[b]);
  }
}

TEST(Grids, TooManyCopiesAreRefused) {
  std::string text = wall;
  text.replace(text.find("[2, 2]"), 6, "[100000, 100000]");
  const SceneReading reading = read(text);
  ASSERT_FALSE(reading.scene);
  EXPECT_NE(reading.problems[0].text().find("10000000000 blocks"), std::string::npos)
      << reading.problems[0].text();
}

TEST(Groups, AreKeptInTheSceneAsRun) {
  std::ostringstream text;
  ddacontact::write_scene(text, scene_of(wall));
  const Scene again = scene_of(text.str());
  EXPECT_EQ(again.blocks[0].groups, (std::vector<std::string>{"wall", "masonry"}));
  EXPECT_EQ(again.blocks[4].groups, std::vector<std::string>{"masonry"});
}

TEST(Selectors, FindBlocksByGroupAndPlace) {
  const auto held = [](const std::string& selector) {
    return blocks_held(
        scene_of(wall + "[[support]]\nblock = " + selector + "\nvertices = [0]\naxes = \"x\"\n"));
  };
  EXPECT_EQ(held("{ group = \"wall\" }"), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(held("{ group = \"masonry\" }"), (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(held("{ box = [0, 0.5, 3, 1] }"), (std::vector<int>{2, 3}));
  EXPECT_EQ(held("{ inside = [[0, 0], [0.9, 0], [0.9, 1]] }"), (std::vector<int>{0}));
  EXPECT_EQ(held("{ at = [1.9, 0.7] }"), (std::vector<int>{3}));
  EXPECT_EQ(held("{ at = [\"190 cm\", 0.7] }"), (std::vector<int>{3}));
}

TEST(Selectors, FindVerticesOnALine) {
  const Scene scene = scene_of(wall +
                               "[[support]]\nblock = { group = \"wall\" }\n"
                               "vertices = { on = [[0, 0], [1.2, 0]] }\n");
  ASSERT_EQ(scene.supports.size(), 2u);
  EXPECT_EQ(scene.supports[0].block, 0);
  EXPECT_EQ(scene.supports[0].vertices, (std::vector<int>{0, 1}));
  EXPECT_EQ(scene.supports[1].block, 1);
  EXPECT_EQ(scene.supports[1].vertices, std::vector<int>{0});
}

TEST(Selectors, FindVerticesAndEdgesInABoxAPolygonAndAtAPoint) {
  const auto held = [](const std::string& place) {
    return scene_of(wall + "[[support]]\nblock = \"base\"\nvertices = " + place + "\n").supports[0].vertices;
  };
  EXPECT_EQ(held("{ box = [4, 0, -2, -2] }"), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(held("{ box = [3, 0.5, 5, -1] }"), (std::vector<int>{1, 2}));
  EXPECT_EQ(held("{ inside = [[-2, -2], [-2, 1], [0, 1]] }"), std::vector<int>{3});
  EXPECT_EQ(held("{ at = [4, -1] }"), std::vector<int>{1});
  EXPECT_EQ(held("{ on = [[4, -1], [4, -1]] }"), std::vector<int>{1});
  const auto loaded = [](const std::string& place) {
    const Scene scene =
        scene_of(wall + "[[load]]\ntype = \"pressure\"\nblock = \"base\"\nvalue = 1\nedge = " + place + "\n");
    return scene.loads.size() == 1 ? scene.loads[0].edge : -1;
  };
  EXPECT_EQ(loaded("{ at = [4, -0.3] }"), 1);
  EXPECT_EQ(loaded("{ box = [-2, -0.5, 5, 0.5] }"), 2);
}

TEST(Selectors, FindEdgesOnALine) {
  const Scene scene = scene_of(wall +
                               "[[load]]\ntype = \"pressure\"\nblock = { group = \"wall\" }\n"
                               "edge = { on = [[0, 1], [5, 1]] }\nvalue = 7\n"
                               "[[load]]\ntype = \"pressure\"\nblock = \"base\"\n"
                               "edge = { on = [[-1, -1], [-1, 0]] }\nvalue = 7\n");
  ASSERT_EQ(scene.loads.size(), 3u);
  EXPECT_EQ(scene.loads[0].block, 2);
  EXPECT_EQ(scene.loads[0].edge, 2);
  EXPECT_EQ(scene.loads[1].block, 3);
  EXPECT_EQ(scene.loads[2].block, 4);
  EXPECT_EQ(scene.loads[2].edge, 3);
}

TEST(Selectors, OfEdgesAreRefusedWhereTheyArePoints) {
  for (const auto& [place, part] : {std::pair{"{ on = [[4, -1], [4, -1]] }", "'on' of 'edge'"},
                                    {"{ box = [4, -1, 4, -1] }", "'box' of 'edge'"}}) {
    const SceneReading reading =
        read(wall + "[[load]]\ntype = \"pressure\"\nblock = \"base\"\nvalue = 1\nedge = " + place + "\n");
    ASSERT_EQ(reading.problems.size(), 1u) << place;
    const Problem& problem = reading.problems[0];
    EXPECT_EQ(problem.line, 27);
    EXPECT_EQ(problem.column, 8);
    for (const char* word : {part, "is a point", "{ at = [x, y] }"})
      EXPECT_NE(problem.text().find(word), std::string::npos) << problem.text();
  }
}

TEST(Selectors, NameMonitorsAfterTheirBlocks) {
  const Scene scene =
      scene_of(wall +
               "[[monitor]]\nname = \"top\"\nblock = { box = [0, 0.5, 3, 1] }\nat = \"centroid\"\n"
               "[[monitor]]\nname = \"one\"\nblock = { at = [0.5, 0.2] }\nvertex = 2\n");
  ASSERT_EQ(scene.monitors.size(), 3u);
  EXPECT_EQ(scene.monitors[0].name, "top.brick.0.1");
  EXPECT_EQ(scene.monitors[1].name, "top.brick.1.1");
  EXPECT_EQ(scene.monitors[2].name, "one");
}

TEST(Selectors, TakeBlocksOutInStages) {
  const Scene scene = scene_of(
      wall +
      "[[stage]]\nsteps = 1\n[[stage]]\nsteps = 1\nremove = [\"brick.1.1\", { box = [0, 0.5, 3, 1] }]\n");
  EXPECT_EQ(scene.stages[1].removed, (std::vector<int>{3, 2}));
}

TEST(Selectors, SayWhatIsNearWhenTheyFindNothing) {
  const std::pair<const char*, std::vector<const char*>> cases[] = {
      {"{ group = \"wal\" }", {"group 'wal'", "did you mean 'wall'?"}},
      {"{ at = [2.6, 0.7] }", {"(2.6, 0.7)", "block 'brick.1.1'", "(2, 0.75)"}},
      {"{ box = [5, 5, 6, 6] }", {"(5.5, 5.5)", "block 'brick.1.1'"}},
      {"{ box = [5, 5, 6] }", {"x0, y0, x1, y1"}},
      {"{ at = [0, 0], group = \"wall\" }", {"one of"}},
      {"{ grop = \"wall\" }", {"'grop'", "did you mean 'group'?"}},
      {"{}", {"one of"}},
  };
  for (const auto& [selector, words] : cases) {
    const SceneReading reading =
        read(wall + "[[support]]\nblock = " + selector + "\nvertices = [0]\naxes = \"x\"\n");
    ASSERT_EQ(reading.problems.size(), 1u) << selector;
    EXPECT_EQ(reading.problems[0].line, 24);
    for (const char* word : words)
      EXPECT_NE(reading.problems[0].text().find(word), std::string::npos) << reading.problems[0].text();
  }
  for (const char* place : {"{ box = [9, 9, 10, 10] }", "{ at = [4, 0.1] }", "{ boks = [9, 9, 10, 10] }",
                            "{ on = [[9, 9], [9, 9]] }"}) {
    // What is held is not known then: nothing is said of what is not held.
    std::string statically = wall + "[[support]]\nblock = \"base\"\nvertices = " + place + "\n";
    statically.replace(statically.find("fixed = true"), 12, "");
    statically.insert(statically.find("gravity"), "mode = \"static\"\n");
    const SceneReading reading = read(statically);
    ASSERT_EQ(reading.problems.size(), 1u) << place << reading.problems[1].text();
    EXPECT_EQ(reading.problems[0].text().find("nan"), std::string::npos) << reading.problems[0].text();
  }
  const SceneReading line =
      read(wall + "[[support]]\nblock = \"base\"\nvertices = { on = [[0, 0.1], [3, 0.1]] }\n");
  ASSERT_EQ(line.problems.size(), 1u);
  EXPECT_NE(line.problems[0].text().find("the nearest vertex is"), std::string::npos)
      << line.problems[0].text();
}

TEST(InitialStress, ChangesWithHeight) {
  const Scene scene = scene_of(wall +
                               "[initial_stress]\nlevel = \"1 m\"\nstress = [\"-1 kPa\", 0, 0]\n"
                               "gradient = [\"1 kN/m3\", 2000.0, 0]\n");
  EXPECT_NEAR(scene.blocks[0].stress[0], -1000 - 750, 1e-9);
  EXPECT_NEAR(scene.blocks[0].stress[1], -1500, 1e-9);
  EXPECT_NEAR(scene.blocks[3].stress[0], -1000 - 250, 1e-9);
  EXPECT_EQ(scene.blocks[3].stress_gradient, ddacontact::Vec3(1000, 2000, 0));
}

TEST(InitialStress, LeavesBlocksThatStateTheirOwn) {
  std::string text = wall;
  text.replace(text.find("fixed = true"), 12, "fixed = true\nstress = [1, 2, 3]");
  const Scene scene = scene_of(text + "[initial_stress]\nstress = [5, 5, 5]\n");
  EXPECT_EQ(scene.blocks[4].stress, ddacontact::Vec3(1, 2, 3));
  EXPECT_EQ(scene.blocks[0].stress, ddacontact::Vec3(5, 5, 5));
}

}  // namespace
