// Bolts of a scene file: what is read, and every way in which it may be wrong.
#include "example_scenes.hpp"

#include <ddacontact/scene/bolt_path.hpp>
#include <ddacontact/scene/writer.hpp>

#include <sstream>

namespace {

using namespace example_scenes;

/// Three blocks of 2 x 1 m in a row, the first one held; the bolt stands in lines 27 to 32.
const std::string row_of_three = R"(format = 1
[analysis]
steps = 3
time_step = 0.01
gravity = [0.0, -10.0]
[[material]]
name = "rock"
density = 2000.0
young = 1e9
poisson = 0.2
[[block]]
name = "a"
material = "rock"
vertices = [[0, 0], [2, 0], [2, 1], [0, 1]]
fixed = true
[[block]]
name = "b"
material = "rock"
vertices = [[2, 0], [4, 0], [4, 1], [2, 1]]
[[block]]
name = "c"
material = "rock"
vertices = [[4, 0], [6, 0], [6, 1], [4, 1]]
[[stage]]
steps = 3
[[bolt]]
name = "b1"
points = [[1, 0.5], [5, 0.5]]
area = "4 cm2"
young = "200 GPa"
pretension = "50 kN"
)";

const std::string grouted =
    replaced(row_of_three, "area", "type = \"grouted\"\nbond_stiffness = \"1 GN/m2\"\narea");

struct BadBolt {
  const char* name;
  const std::string& scene;
  const char* from;
  const char* to;
  int line, column;
  std::vector<const char*> words;
};
void PrintTo(const BadBolt& c, std::ostream* out) {
  *out << c.name;
}

const BadBolt bad_bolts[] = {
    {"NoName", row_of_three, "name = \"b1\"", "", 26, 1, {"missing key 'name'"}},
    {"OnePoint", row_of_three, "[[1, 0.5], [5, 0.5]]", "[[1, 0.5]]", 28, 10, {"1 points", "straight"}},
    {"ThreePoints", row_of_three, "[5, 0.5]]", "[5, 0.5], [6, 1]]", 28, 10, {"3 points"}},
    {"NoLength", row_of_three, "[5, 0.5]", "[1, 0.5]", 28, 10, {"no length", "(1, 0.5)"}},
    {"Outside",
     row_of_three,
     "[5, 0.5]",
     "[5, 1.5]",
     28,
     21,
     {"outside all blocks", "block 'c', 0.5 m away"}},
    {"OnAFace", row_of_three, "[5, 0.5]", "[4, 0.5]", 28, 21, {"face between block 'b' and block 'c'"}},
    {"SameBlock", row_of_three, "[5, 0.5]", "[1.5, 0.5]", 28, 10, {"block 'a' alone", "join two blocks"}},
    {"AllHeld",
     row_of_three,
     "vertices = [[4, 0], [6, 0]",
     "fixed = true\nvertices = [[4, 0], [6, 0]",
     29,
     10,
     {"all fixed"}},
    {"NoArea", row_of_three, "\"4 cm2\"", "0", 29, 8, {"'area'", "> 0"}},
    {"AreaOfALength", row_of_three, "\"4 cm2\"", "\"4 cm\"", 29, 8, {"'area'", "m2"}},
    {"BondOfAnchored",
     row_of_three,
     "area",
     "bond_strength = 5\narea",
     29,
     17,
     {"'bond_strength'", "anchored"}},
    {"TooTense",
     row_of_three,
     "area",
     "yield_force = \"40 kN\"\narea",
     32,
     14,
     {"'pretension'", "yield_force"}},
    {"TornAtOnce", row_of_three, "area", "rupture_strain = 1e-6\narea", 32, 14, {"rupture_strain"}},
    {"UnknownType", row_of_three, "area", "type = \"grout\"\narea", 29, 8, {"'type'", "grouted"}},
    {"NoBond", row_of_three, "area", "type = \"grouted\"\narea", 26, 1, {"missing key 'bond_stiffness'"}},
    {"BondOfAPressure", grouted, "1 GN/m2", "1 GN/m", 30, 18, {"'bond_stiffness'", "N/m2"}},
    {"GroutedInOne", grouted, "[5, 0.5]", "[1.5, 0.5]", 28, 10, {"block 'a' alone"}},
    {"GroutedOutside", grouted, "[1, 0.5]", "[-1, 0.5]", 28, 11, {"outside all blocks", "block 'a'"}},
    {"Classic",
     row_of_three,
     "[[material]]",
     "[contact]\nmethod = \"classic\"\n[[material]]",
     28,
     1,
     {"bolts need the contact method 'staged'"}},
    {"AddsUnknown",
     row_of_three,
     "steps = 3\n[[bolt]]",
     "steps = 3\nadd = [\"b2\"]\n[[bolt]]",
     26,
     8,
     {"'b2'", "did you mean 'b'"}},
    {"AddsTwice",
     row_of_three,
     "steps = 3\n[[bolt]]",
     "steps = 3\nadd = [\"b1\", \"b1\"]\n[[bolt]]",
     26,
     14,
     {"bolt 'b1' stands twice"}},
};

class BadBolts : public testing::TestWithParam<BadBolt> {};

}  // namespace

TEST_P(BadBolts, AreRefusedWithPlaceAndCure) {
  const BadBolt& c = GetParam();
  const SceneReading reading = read(replaced(c.scene, c.from, c.to));
  ASSERT_FALSE(reading.scene);
  ASSERT_FALSE(reading.problems.empty());
  const Problem& problem = reading.problems.front();
  EXPECT_EQ(problem.line, c.line) << problem.text();
  EXPECT_EQ(problem.column, c.column) << problem.text();
  for (const char* word : c.words)
    EXPECT_NE(problem.text().find(word), std::string::npos) << word << " in " << problem.text();
}
INSTANTIATE_TEST_SUITE_P(All, BadBolts, testing::ValuesIn(bad_bolts),
                         [](const auto& each) { return each.param.name; });

TEST(BoltTables, AreReadAndWritten) {
  const std::string text = replaced(
      replaced(grouted, "steps = 3\n[[bolt]]", "steps = 3\nadd = [\"b1\"]\n[[bolt]]"), "area",
      "bond_strength = \"100 kN/m\"\nyield_force = \"200 kN\"\nrupture_strain = 0.05\nspacing = 1.5\narea");
  const Scene scene = scene_of(text);
  ASSERT_EQ(scene.bolts.size(), 1u);
  const ddacontact::RockBolt& bolt = scene.bolts[0];
  EXPECT_EQ(bolt.name, "b1");
  EXPECT_EQ(bolt.area, 4e-4);
  EXPECT_EQ(bolt.bond_stiffness, 1e9);
  EXPECT_EQ(bolt.bond_strength, 1e5);
  EXPECT_EQ(bolt.yield_force, 2e5);
  EXPECT_EQ(bolt.spacing, 1.5);
  EXPECT_EQ(scene.stages[0].bolts, std::vector<int>{0});
  std::ostringstream written;
  ddacontact::write_scene(written, scene);
  std::ostringstream again;
  ddacontact::write_scene(again, scene_of(written.str()));
  EXPECT_EQ(written.str(), again.str());
  EXPECT_NE(written.str().find("\nbond_strength = 1"), std::string::npos);
}

TEST(BoltPaths, PassEveryBlockOnceInOrder) {
  Scene scene = scene_of(grouted);
  ddacontact::RockBolt bolt = scene.bolts[0];
  std::swap(bolt.from, bolt.to);
  const std::vector<ddacontact::BoltPiece> pieces = ddacontact::bolt_pieces(bolt, scene.blocks);
  ASSERT_EQ(pieces.size(), 3u);
  EXPECT_EQ(pieces[0].block, 2);
  EXPECT_EQ(pieces[2].block, 0);
  EXPECT_DOUBLE_EQ(pieces[1].from, 1);
  EXPECT_DOUBLE_EQ(pieces[1].to, 3);
  double bonded = 0;
  for (const ddacontact::BoltNode& node : ddacontact::bolt_nodes(bolt, scene.blocks)) bonded += node.length;
  EXPECT_NEAR(bonded, 4, 1e-12);
}

TEST(StaticScenes, MayHangABlockOnABolt) {
  std::string text = replaced(row_of_three, "time_step", "mode = \"static\"\ntime_step");
  text = replaced(text, "[[4, 0], [6, 0], [6, 1], [4, 1]]", "[[14, 0], [16, 0], [16, 1], [14, 1]]");
  EXPECT_FALSE(read(replaced(text, "[5, 0.5]", "[3, 0.5]")).scene);
  EXPECT_TRUE(read(replaced(text, "[5, 0.5]", "[15, 0.5]")).scene);
}
