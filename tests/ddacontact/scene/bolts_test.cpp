// Bolts of a scene file: what is read, and every way in which it may be wrong.
#include "example_scenes.hpp"

#include <ddacontact/scene/bolt_path.hpp>
#include <ddacontact/scene/writer.hpp>

#include <sstream>

using namespace example_scenes;

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

TEST(BoltTables, WarnOfWhatIsGoneWhenAGroutedOneComesIn) {
  const SceneReading reading =
      read(replaced(grouted, "steps = 3\n[[bolt]]", "steps = 3\nremove = [\"c\"]\nadd = [\"b1\"]\n[[bolt]]"));
  ASSERT_TRUE(reading.scene);
  EXPECT_NE(all_text(reading.problems).find("warning: bolt 'b1' comes in when block 'c'"), std::string::npos)
      << all_text(reading.problems);
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
