/// \file [domain]: its blocks, their joints, and what is refused.
#include "example_scenes.hpp"

#include <ddacontact/scene/builder.hpp>
#include <ddacontact/scene/made_scenes.hpp>
#include <ddacontact/scene/writer.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <sstream>

namespace {

using namespace example_scenes;
using namespace ddacontact;

constexpr std::string_view head = R"(
[analysis]
steps = 2
time_step = 0.01
[[material]]
name = "rock"
density = 2500
young = 5e9
poisson = 0.2
[[material]]
name = "soil"
density = 2000
young = 5e8
poisson = 0.2
[[joint]]
name = "usual"
friction_angle = 40
[[joint]]
name = "bedding"
friction_angle = 10
[domain]
boundary = [[0, 0], [4, 0], [4, 3], [0, 3]]
)";

/// How many warnings say that a joint is never used.
auto n_unused_joints(const SceneReading& reading) {
  return std::ranges::count_if(reading.problems, [](const Problem& problem) {
    return problem.text().find("is never used") != std::string::npos;
  });
}

TEST(UnusedJoints, AreWarnedOfWhereTheBlocksAreKnown) {
  const std::string domain(head), set = "[[domain.joint_set]]\njoint = \"bedding\"\nangle = 0\nspacing = 1\n";
  const auto read = [](const std::string& text) { return read_scene_text(text, "scene.toml"); };
  EXPECT_EQ(n_unused_joints(read(domain)), 1);
  EXPECT_EQ(n_unused_joints(read(domain + set)), 0);
  std::string crossed = domain;
  crossed.replace(crossed.find("[4, 0], [4, 3]"), 14, "[4, 3], [4, 0]");
  EXPECT_EQ(n_unused_joints(read(crossed)), 0);
  std::string of_soil = domain + set;
  of_soil.insert(of_soil.find("[domain]"), "[[joint]]\nname = \"contact\"\nbetween = [\"rock\", \"soil\"]\n");
  const SceneReading reading = read(of_soil);
  ASSERT_EQ(n_unused_joints(reading), 1);
  EXPECT_NE(all_text(reading.problems).find("no two blocks have the materials"), std::string::npos);
  // The first one without 'between' is the default, wherever it stands.
  const std::string last = "[[joint]]\nname = \"within\"\nbetween = [\"rock\", \"rock\"]\n[[joint]]\n";
  const auto is_told = [&](const std::string& text) {
    return all_text(read(std::string(minimal) + text).problems).find("has no 'between'") != std::string::npos;
  };
  EXPECT_FALSE(is_told(last));
  EXPECT_TRUE(is_told(last + "[[joint]]\n"));
}

/// Squares of 1 m; the joints between rows are bedding.
constexpr std::string_view squares = R"([[domain.joint_set]]
angle = 90
spacing = 1
[[domain.joint_set]]
joint = "bedding"
angle = 0
spacing = "1 m"
)";

SceneReading reading(std::string_view tables) {
  return read_scene_text(std::string(head) + std::string(tables), "scene.toml");
}

Scene scene(std::string_view tables) {
  SceneReading result = reading(tables);
  EXPECT_TRUE(result.scene) << all_text(result.problems);
  EXPECT_TRUE(result.problems.empty()) << all_text(result.problems);
  return result.scene.value_or(Scene());
}

void expect_problem(std::string_view tables, const std::string& text) {
  const SceneReading result = reading(tables);
  EXPECT_FALSE(result.scene);
  EXPECT_NE(all_text(result.problems).find(text), std::string::npos) << all_text(result.problems);
}

TEST(Domain, GivesNamedBlocksThatKnowTheirJoints) {
  const Scene cut = scene(squares);
  ASSERT_EQ(cut.blocks.size(), 12u);
  EXPECT_EQ(cut.blocks[5].name, "d5");
  EXPECT_EQ(cut.blocks[5].edge_joints, (std::vector{1, -1, 1, -1}));
  EXPECT_EQ(cut.domain->blocks, 12);
  EXPECT_EQ(cut.domain->area, 12);
}

TEST(Domain, ContactsFollowTheJointOfTheirEdge) {
  const BuiltScene built = build(scene(squares));
  const ContactProperties& properties = built.stepper->contact_properties();
  EXPECT_EQ(properties.joint_of({.vertex_block = 9, .vertex = 0, .edge_block = 5, .edge = 2}), 1);
  EXPECT_EQ(properties.joint_of({.vertex_block = 6, .vertex = 0, .edge_block = 5, .edge = 1}), 0);
  EXPECT_LT(properties.strength({.vertex_block = 9, .vertex = 0, .edge_block = 5, .edge = 2}).friction, 0.2);
}

TEST(Domain, IsWrittenBackAsItsBlocks) {
  const Scene cut = scene(squares);
  std::ostringstream text, again;
  write_scene(text, cut);
  EXPECT_EQ(text.str().find("[domain]"), std::string::npos);
  const SceneReading back = read_scene_text(text.str(), "again.toml");
  ASSERT_TRUE(back.scene) << all_text(back.problems);
  write_scene(again, *back.scene);
  EXPECT_EQ(again.str(), text.str());
  EXPECT_EQ(back.scene->blocks[5].edge_joints, cut.blocks[5].edge_joints);
}

TEST(Domain, RegionsGiveMaterialsModelsAndHolds) {
  const Scene cut = scene(std::string(squares) + R"([[domain.region]]
name = "low"
polygon = [[-1, -1], [5, -1], [5, 1], [-1, 1]]
material = "soil"
fixed = true
group = "base"
[[domain.region]]
name = "left"
polygon = [[-1, -1], [1, -1], [1, 5], [-1, 5]]
model = "affine"
)");
  EXPECT_TRUE(cut.blocks[0].fixed && cut.blocks[3].fixed && !cut.blocks[4].fixed);
  EXPECT_EQ(cut.blocks[0].material, 1);
  EXPECT_EQ(cut.blocks[4].material, 0);
  EXPECT_EQ(cut.blocks[4].model, BlockModel::affine);
  EXPECT_EQ(cut.blocks[3].groups, std::vector<std::string>{"base"});
}

TEST(Domain, OfSeveralRegionsTheLastOneDecidesWhatIsHeld) {
  const std::string held =
      std::string(squares) +
      "[[domain.region]]\nname = \"all\"\npolygon = [[-1, -1], [5, -1], [5, 5], [-1, 5]]\n"
      "fixed = true\n[[domain.region]]\nname = \"left\"\n"
      "polygon = [[-1, -1], [1, -1], [1, 5], [-1, 5]]\n";
  EXPECT_TRUE(scene(held).blocks[0].fixed);
  const Scene cut = scene(held + "fixed = false\n");
  EXPECT_TRUE(!cut.blocks[0].fixed && cut.blocks[3].fixed);
}

/// Forces of contacts are round-off, which the solver must not take for forces.
TEST(Domain, WithoutWeightStaysWhereItIs) {
  for (const char* cohesion : {"", "cohesion = 1e5\n"})
    for (const double first : {-83., 40.})
      for (const double second : {-76., 74., 15.}) {
        std::ostringstream text;
        text << "format = 1\n[analysis]\ntime_step = 0.01\nsteps = 2\nblock_model = \"affine\"\n"
             << "gravity = [0, 0]\n[[material]]\nname = \"r\"\ndensity = 2500\nyoung = 1e10\n"
             << "poisson = 0.2\n[[joint]]\nfriction_angle = 30\n"
             << cohesion << "[domain]\nboundary = [[0, 0], [2, 0], [2, 2], [0, 2]]\n"
             << "[[domain.joint_set]]\nangle = " << first << "\nspacing = 0.5\n"
             << "[[domain.joint_set]]\nangle = " << second << "\nspacing = 1\n";
        SCOPED_TRACE(text.str());
        const BuiltScene built = build(*read(text.str()).scene);
        const Points start = built.stepper->state().position;
        for (int step = 0; step < 2; ++step)
          EXPECT_TRUE(built.stepper->step()) << built.stepper->stop_reason();
        EXPECT_LT((built.stepper->state().position - start).cwiseAbs().maxCoeff(), 1e-11);
      }
}

TEST(Domain, OpeningsAreGroupsOrEmpty) {
  const std::string opening = std::string(squares) + R"([[domain.opening]]
name = "shaft"
polygon = [[1, 1], [2, 1], [2, 3], [1, 3]]
)";
  const auto in_shaft = [](const BlockDescription& block) { return !block.groups.empty(); };
  const Scene full = scene(opening), empty = scene(opening + "excavated = true\n");
  EXPECT_EQ(std::ranges::count_if(full.blocks, in_shaft), 2);
  EXPECT_EQ(empty.blocks.size(), 10u);
  EXPECT_EQ(std::ranges::count_if(empty.blocks, in_shaft), 0);
}

TEST(Domain, SettingsReachJointSets) {
  const std::string text = std::string(head) + std::string(squares);
  const SceneReading wider = read_scene_text(text, "scene.toml", {"domain.joint_set.1.spacing=1.5"});
  ASSERT_TRUE(wider.scene) << all_text(wider.problems);
  EXPECT_EQ(wider.scene->blocks.size(), 8u);
}

TEST(Domain, BadTablesAreRefusedWithPlaceAndCure) {
  const auto with = [](std::string_view lines) { return std::string(squares) + std::string(lines); };
  expect_problem("[[domain.joint_set]]\nangle = 0\nspacing = 0\n",
                 "scene.toml:25:11: error: 'spacing' = '0' is out of range");
  expect_problem("[[domain.joint_set]]\nangle = 0\nspacing = 1\ngap = 1\n", "error: 'gap' without 'trace'");
  expect_problem("[[domain.joint_set]]\nangle = 0\nspacing = 1\ndip = 1\n", "write 'angle': of the traces");
  expect_problem("[[domain.joint_set]]\nangel = 0\nspacing = 1\n",
                 "in [[domain.joint_set]] (write 'angle': a number");
  expect_problem(with("joint = \"beding\"\n"), "");
  expect_problem("[[domain.joint_set]]\nangle = 0\nspacing = 1\njoint = \"beding\"\n",
                 "scene.toml:26:9: error: unknown joint 'beding' (did you mean 'bedding'?)");
  expect_problem(with("inside = \"slop\"\n"), "unknown region 'slop'");
  expect_problem(with("[[domain.opening]]\nname = \"t\"\n"), "the opening has no outline");
  expect_problem(
      with("[[domain.opening]]\nname = \"t\"\ncircle = { centre = [1, 1], radius = 1, edgs = 3 }\n"),
      "unknown key 'edgs' in 'circle' (did you mean 'edges'?)");
  expect_problem(with("[[domain.trace]]\npoints = [[1, 1], [1, 1]]\n"), "the same point twice");
  expect_problem(
      "[[domain.joint_set]]\nangle = 0\nspacing = 1e-6\n[[domain.joint_set]]\nangle = 90\nspacing = 1e-6\n",
      "the domain would be cut into about 1.2e+13 blocks");
  expect_problem(
      "[[domain.joint_set]]\nangle = 30\nspacing = 1\n[[domain.joint_set]]\nangle = 90\nspacing = 1e-8\n",
      "scene.toml:28:11: error: the domain would be cut into about");
  expect_problem(with("[domain.sliver]\narea = 2\n"), "'area' = '2' is out of range");
}

/// Oblique slivers 3 m long: their boxes overlap by the thousand, and it is those pairs that take memory.
TEST(Domain, JointsThatCutMoreThanMemoryHoldsAreRefusedBeforeAnythingIsCut) {
  const auto begin = std::chrono::steady_clock::now();
  expect_problem("[[domain.joint_set]]\nangle = 45\nspacing = 1e-5\n",
                 "scene.toml:25:11: error: the domain would be cut into about 3.464e+05 blocks");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(1));
}

/// A slope of squares whose face looks to the left; the toe is 1 m above the bottom.
std::string slope(const std::string& tables) {
  std::string text(head);
  text.replace(text.find("[0, 3]]"), 7, "[2, 3], [1, 1], [0, 1]]");
  return text + std::string(squares) + tables;
}

/// Warnings that a side of the domain is not held.
std::vector<std::string> free_sides(const std::string& text) {
  const SceneReading result = read_scene_text(text, "scene.toml");
  EXPECT_TRUE(result.scene) << all_text(result.problems);
  std::vector<std::string> found;
  for (const Problem& problem : result.problems)
    if (problem.text().find("side of the domain is not held") != std::string::npos)
      found.push_back(problem.text());
  return found;
}

constexpr const char* base = "[[domain.region]]\nname = \"base\"\nfixed = true\npolygon = ";

TEST(FreeSides, OfASlopeThatIsHeldBelowAloneAreWarnedOf) {
  const std::vector<std::string> warnings =
      free_sides(slope(base + std::string("[[0, 0], [4, 0], [4, 1], [0, 1]]\n")));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("scene.toml:22:12: warning: the right side of the domain is not held between "
                             "[4, 1] and [4, 3]"),
            std::string::npos)
      << warnings[0];
  EXPECT_NE(warnings[0].find("'vertices' = { on = [[4, 1], [4, 3]] }"), std::string::npos) << warnings[0];
}

TEST(FreeSides, BelowAreWarnedOfToo) {
  const std::vector<std::string> warnings =
      free_sides(slope(base + std::string("[[3, 0], [4, 0], [4, 3], [3, 3]]\n")));
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[0].find("left side of the domain is not held between [0, 0] and [0, 1]"),
            std::string::npos)
      << warnings[0];
  EXPECT_NE(warnings[1].find("bottom side of the domain is not held between [0, 0] and [3, 0]"),
            std::string::npos)
      << warnings[1];
}

TEST(FreeSides, ThatAreHeldInTheMiddleAreWarnedOfOnBothSidesOfIt) {
  const std::vector<std::string> warnings =
      free_sides(slope(base + std::string("[[3, 1], [4, 1], [4, 2], [3, 2]]\n")));
  ASSERT_EQ(warnings.size(), 4u);
  EXPECT_NE(warnings[1].find("right side of the domain is not held between [4, 0] and [4, 1]"),
            std::string::npos)
      << warnings[1];
  EXPECT_NE(warnings[2].find("right side of the domain is not held between [4, 2] and [4, 3]"),
            std::string::npos)
      << warnings[2];
  EXPECT_NE(warnings[3].find("bottom side of the domain is not held between [0, 0] and [4, 0]"),
            std::string::npos)
      << warnings[3];
}

TEST(FreeSides, AreNoneWhereSupportsPressuresBlocksOrQuietBoundariesHoldThem) {
  const std::string below = base + std::string("[[0, 0], [4, 0], [4, 1], [0, 1]]\n");
  for (const std::string holder :
       {"[[support]]\nblock = { box = [3, 0, 4, 3] }\nvertices = { on = [[4, 0], [4, 3]] }\naxes = \"x\"\n",
        "[[load]]\ntype = \"pressure\"\nblock = { box = [3, 1, 4, 3] }\nedge = { on = [[4, 0], [4, 3]] }\n"
        "value = 1e3\n",
        "[[quiet_boundary]]\non = [[4, 1], [4, 3]]\n",
        "[[block]]\nmaterial = \"rock\"\nfixed = true\nvertices = [[4, 0], [5, 0], [5, 3], [4, 3]]\n"})
    EXPECT_TRUE(free_sides(slope(below + holder)).empty()) << holder;
}

TEST(FreeSides, AreLeftAloneWhereNothingOfTheDomainIsHeldAndOfSpecimens) {
  EXPECT_TRUE(free_sides(slope("")).empty());
  const std::string below = base + std::string("[[0, 0], [4, 0], [4, 1], [0, 1]]\n");
  EXPECT_TRUE(free_sides(std::string(head) + std::string(squares) + below).empty());
  EXPECT_EQ(free_sides(std::string(head) + std::string(squares) + below +
                       "[[domain.opening]]\nname = \"t\"\npolygon = [[1.5, 1.5], [2.5, 1.5], [2, 2.5]]\n")
                .size(),
            2u);
}

TEST(FreeSides, AreNotInTheExamples) {
  int n_domains = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(POLYDDA_EXAMPLES)) {
    if (entry.path().extension() != ".toml") continue;
    const SceneReading result = read_scene(entry.path().string());
    ASSERT_TRUE(result.scene) << entry.path() << all_text(result.problems);
    EXPECT_EQ(all_text(result.problems).find("side of the domain"), std::string::npos) << entry.path();
    n_domains += result.scene->domain.has_value();
  }
  EXPECT_EQ(n_domains, 4);
}

TEST(FreeSides, AreNotInScenesThatAreMade) {
  for (const std::string& text : {made_scene(MadeSlope()), made_scene(MadeTunnel())})
    EXPECT_TRUE(free_sides(text).empty());
}

TEST(Domain, OneErrorHidesNoOther) {
  const SceneReading reading =
      read_scene_text(std::string(head) +
                          "[[domain.region]]\nname = \"low\"\npolygon = [[0, 0], [4, 2], [4, 0], [0, 2]]\n"
                          "cut = true\njoint = \"nope\"\ngrou = \"low\"\n",
                      "scene.toml");
  const std::string text = all_text(reading.problems);
  for (const char* what :
       {"unknown key 'grou'", "the region 'low' intersects itself", "unknown joint 'nope'"})
    EXPECT_NE(text.find(what), std::string::npos) << text;
}

TEST(Domain, OfAnUnknownParameterNothingIsCut) {
  std::string text(head);
  text.replace(text.find("[4, 3]"), 6, "[\"$width\", 3]");
  const SceneReading reading = read_scene_text(text, "scene.toml");
  ASSERT_EQ(reading.problems.size(), 1u) << all_text(reading.problems);
  EXPECT_NE(reading.problems[0].what.find("unknown parameter '$width'"), std::string::npos);
}

/// Lines of the outline and of loops that are snapped to a point, and a wedge thinner than the noding's grid.
TEST(Domain, WhatIsSmallerThanTheSnapIsLeftOutAndOpeningsSo) {
  const std::string text(head), coarse = text + "snap = 0.5\n";
  const auto warnings = [](const std::string& scene) {
    const SceneReading reading = read_scene_text(scene, "scene.toml");
    EXPECT_TRUE(reading.scene && reading.scene->blocks.size() == 1) << all_text(reading.problems);
    return all_text(reading.problems);
  };
  const std::string opening = "[[domain.opening]]\nname = \"hole\"\ncircle = { centre = [2, 1.5], radius = ";
  EXPECT_NE(warnings(coarse + opening + "0.2 }\n").find("the opening 'hole' is smaller than what lines are"),
            std::string::npos);
  EXPECT_NE(warnings(text + opening + "1e-7 }\n").find("has no effect"), std::string::npos);
  EXPECT_EQ(
      warnings(coarse + "[[domain.trace]]\npoints = [[2, 2], [2.2, 2], [2.1, 2.2], [2, 2]]\n").find("hole"),
      std::string::npos);
}

TEST(Domain, CellsOfRoundOffAreNoBlocks) {
  std::string text(head);
  text.replace(text.find("[[0, 0], [4, 0], [4, 3], [0, 3]]"), 32, "[[0, 0], [12, 0], [0, 10]]");
  for (const char* height : {"1e-8", "1e-9", "1e-10", "1e-12"}) {
    const SceneReading reading = read_scene_text(
        text +
            "[[domain.joint_set]]\nangle = -65\nspacing = 3\ninside = \"base\"\n[[domain.region]]\n"
            "name = \"base\"\npolygon = [[0, " +
            height + "], [12, 0], [0, 6]]\ncut = true\n",
        "scene.toml");
    EXPECT_TRUE(reading.scene) << height << ": " << all_text(reading.problems);
  }
}

TEST(Domain, WhatLiesOutsideIsWarnedOf) {
  const auto warnings = [](const std::string& more) {
    std::string text;
    for (const Problem& problem : reading(std::string(squares) + more).problems)
      if (problem.text().find("no effect") != std::string::npos) text += problem.text() + '\n';
    return text;
  };
  const std::string opening = "[[domain.opening]]\nname = \"adit\"\nexcavated = true\ncircle = { centre = [",
                    region = "[[domain.region]]\nname = \"dyke\"\npolygon = [[";
  EXPECT_EQ(warnings(opening + "2, 1.5], radius = 0.4 }\n"), "");
  EXPECT_NE(warnings(opening + "2000, 1500], radius = 400 }\n")
                .find("the opening 'adit' lies outside the domain and has no effect"),
            std::string::npos);
  EXPECT_EQ(warnings(region + "0, 0], [2, 0], [0, 2]]\n"), "");
  EXPECT_NE(warnings(region + "10, 0], [12, 0], [10, 2]]\n").find("the region 'dyke' lies outside"),
            std::string::npos);
  EXPECT_EQ(warnings("[[domain.trace]]\npoints = [[-1, 1.5], [5, 1.6]]\n"), "");
  EXPECT_NE(warnings("[[domain.trace]]\npoints = [[-1, 5], [5, 5]]\n").find("trace lies outside"),
            std::string::npos);
  const std::string outside = "[[domain.trace]]\npoints = [[9, 5], [9, 6]]\n";
  EXPECT_NE(warnings(outside + outside + outside).find("the trace, with 2 others, lies outside"),
            std::string::npos);
  // A region that holds no centroid may still be where a joint set is.
  EXPECT_EQ(
      warnings("[[domain.region]]\nname = \"band\"\npolygon = [[-1, 0.9], [5, 0.9], [5, 1.1], [-1, 1.1]]\n"),
      "");
}

TEST(Domain, EdgeJointsOfABlockAreOnePerEdge) {
  const std::string block =
      "[[block]]\nmaterial = \"rock\"\nvertices = [[9, 0], [10, 0], [9, 1]]\nedge_joints = ";
  EXPECT_EQ(scene(std::string(squares) + block + "[\"\", 1, \"usual\"]\n").blocks[0].edge_joints,
            (std::vector{-1, 1, 0}));
  expect_problem(std::string(squares) + block + "[\"\", 1]\n", "names 2 joints for 3 edges");
}

TEST(EdgeJoints, OfOneSideAloneAreWarnedOf) {
  const std::string two =
                        "analysis = { steps = 1, time_step = 1e-2 }\njoint = [{ name = \"usual\" }, { name = "
                        "\"weak\" }]\n[[material]]\nname = \"rock\"\nyoung = 1e9\npoisson = 0.2\ndensity = "
                        "2500\n",
                    lower =
                        "[[block]]\nmaterial = \"rock\"\nfixed = true\nvertices = [[0, 0], [3, 0], [3, 1], "
                        "[0, 1]]\n",
                    upper =
                        "[[block]]\nmaterial = \"rock\"\nvertices = [[1, 1], [2, 1], [2, 2], [1, 2]]\n"
                        "edge_joints = [\"weak\", \"\", \"\", \"\"]\n";
  const std::string text = all_text(read_scene_text(two + lower + upper, "scene.toml").problems);
  EXPECT_NE(text.find("edge 2 of block 0 follows joint \"usual\", edge 0 of block 1, which it touches, joint "
                      "\"weak\": each contact follows the edge"),
            std::string::npos)
      << text;
  const std::string both = lower + "edge_joints = [\"\", \"\", 1, \"\"]\n" + upper;
  EXPECT_EQ(all_text(read_scene_text(two + both, "scene.toml").problems), "");
}

}  // namespace
