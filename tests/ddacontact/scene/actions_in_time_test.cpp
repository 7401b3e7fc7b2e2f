/// \file Histories from tables and files, shaking of the ground, and water: read, refused, and written again.
#include "geometry_scenes.hpp"

#include <ddacontact/scene/record_notes.hpp>
#include <ddacontact/scene/writer.hpp>

#include <algorithm>
#include <sstream>

namespace {

using namespace geometry_scenes;
using Kind = ddacontact::TimeFunction::Kind;
using ddacontact::Vec2;
using ddacontact::Vec3;

class ActionsInTime : public GeometryScenes {
 protected:
  SceneReading read_scene(const std::string& more) const {
    return ddacontact::read_scene_text(std::string(minimal) + more, "scene.toml", {}, directory());
  }
  Scene scene_with_more(const std::string& more) const {
    const SceneReading reading = read_scene(more);
    EXPECT_TRUE(reading.scene) << all_text(reading.problems) << more;
    return reading.scene.value_or(Scene{});
  }
  /// The only problem, with its file, line and column.
  std::string problem_of(const std::string& more) const {
    const SceneReading reading = read_scene(more);
    EXPECT_EQ(reading.problems.size(), 1u) << all_text(reading.problems);
    return reading.problems.empty() ? "" : reading.problems.front().text();
  }
};

std::string written(const Scene& scene) {
  std::ostringstream out;
  ddacontact::write_scene(out, scene);
  return out.str();
}

constexpr const char* support = "[[support]]\nblock = 0\nvertices = [0]\n";
constexpr const char* quake = "[[quake]]\nacceleration = \"record.csv\"\n";

TEST_F(ActionsInTime, AFileSaysItsColumnsAndUnits) {
  write("record.csv", "# station 7\nt [ms], ay [cm/s2], ax [g]\n0, 100, 0\n\n10,-50,0.5\r\n");
  const Scene scene = scene_with_more(quake);
  ASSERT_EQ(scene.quakes.size(), 1u);
  const std::vector<Vec3>& entries = scene.quakes[0].acceleration.history;
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_NEAR((entries[0] - Vec3(0, 0, 1)).norm(), 0, 1e-15);
  EXPECT_NEAR((entries[1] - Vec3(0.01, 4.903325, -0.5)).norm(), 0, 1e-15);
}

TEST_F(ActionsInTime, AQuakeBeforeBlocksCanMoveIsWarnedOf) {
  const auto said = [&](const char* begin, const char* mode) {
    const std::string stages = std::string("[[stage]]\nsteps = 20\nmode = \"") + mode +
                               "\"\n[[stage]]\nsteps = 5\n[[quake]]\nacceleration = [[" + begin +
                               ", 0, 0], [0.3, 1, 0], [0.4, 0, 0]]\n";
    return all_text(ddacontact::read_scene_text(std::string(minimal) + stages, "scene.toml",
                                                {"block.0.fixed=[0]"}, directory())
                        .problems);
  };
  EXPECT_NE(said("0.1", "static").find("warning: the record shakes the ground between t = 0 and 0.2 s"),
            std::string::npos);
  EXPECT_EQ(said("0.2", "static"), "");
  EXPECT_EQ(said("0.1", "dynamic"), "");
}

TEST_F(ActionsInTime, AQuakeIsScaledAndMayStandInATable) {
  const Scene scene =
      scene_with_more("[[quake]]\nacceleration = [[0, 1, 2], [1, \"0.3 m/s2\", 0]]\nscale = 2\n");
  EXPECT_EQ(scene.quakes[0].acceleration.history[0], Vec3(0, 2, 4));
  EXPECT_EQ(scene.quakes[0].acceleration.history[1], Vec3(1, 0.6, 0));
}

TEST_F(ActionsInTime, EveryHistoryOfASupportIsWrittenAsItWasRead) {
  write("motion.csv", "t,ux,uy\n0,0,0\n1,0.1,0.3\n2,0,0\n");
  for (const auto& [text, kind] :
       {std::pair{"history = [[0, 0, 0], [1, 1, 2]]", Kind::history},
        {"history = [[0, 0, 0], [1, 1, 2], [3, 0, 0]]\ninterpolation = \"smooth\"", Kind::smooth_history},
        {"history = \"motion.csv\"", Kind::smooth_history},
        {"history = \"motion.csv\"\ninterpolation = \"linear\"", Kind::history},
        {"velocity_history = [[0, 0, 0], [1, 1, 2]]", Kind::velocity_history},
        {"acceleration_history = \"motion.csv\"", Kind::acceleration_history}}) {
    const Scene scene = scene_with_more(support + std::string(text) + "\n"), again = scene_of(written(scene));
    EXPECT_EQ(scene.supports[0].displacement.kind, kind) << text;
    EXPECT_EQ(again.supports[0].displacement.kind, kind) << text;
    for (const double t : {-1.0, 0.0, 0.3, 1.0, 1.7, 5.0})
      EXPECT_EQ(again.supports[0].displacement.at(t, 1), scene.supports[0].displacement.at(t, 1)) << text;
  }
}

TEST_F(ActionsInTime, PressuresHaveAHistoryAndLoadsARamp) {
  const std::string pressure = "[[load]]\ntype = \"pressure\"\nblock = 0\nedge = 1\n";
  const Scene scene = scene_with_more(pressure + "history = [[0, \"1 kPa\"], [1, 3000]]\nramp = \"2 s\"\n"),
              again = scene_of(written(scene));
  for (const Scene* one : {&scene, &again}) EXPECT_EQ(one->loads[0].force.at(0.5, 9), Vec2(500, 0));
  EXPECT_NE(problem_of(pressure + "history = [[0, 1, 1]]\n").find("entries [t, value]"), std::string::npos);
  EXPECT_NE(problem_of(pressure + "value = 1\nhistory = [[0, 1]]\n").find("both 'value' and 'history'"),
            std::string::npos);
  EXPECT_NE(problem_of(support + std::string("history = [[0, 1]]\n")).find("[t, x, y]"), std::string::npos);
  EXPECT_NE(problem_of(pressure + "value = 1\nramp = 0\n").find("'ramp' = '0'"), std::string::npos);
}

TEST_F(ActionsInTime, FilesAreRefusedWithTheirLineAndCure) {
  const auto refuses = [&](std::string_view text, std::initializer_list<const char*> words) {
    write("record.csv", text);
    const std::string problem = problem_of(quake);
    for (const char* word : words) EXPECT_NE(problem.find(word), std::string::npos) << problem;
  };
  refuses("t,ax,ay\n0,0,0\n0.1,,0\n", {"record.csv:3:5", "'' is no number", "gaps"});
  refuses("t,ax,ay\n0,0,0\n0.1,nan,0\n", {"record.csv:3:5", "'nan'"});
  refuses("t,ax,ay\n0,0,0\n0.1,0\n", {"record.csv:3:1", "2 cells", "header 3"});
  refuses("t,ax\n0,0\n0.2,1\n0.1,1\n", {"record.csv:4:1", "not later", "increase"});
  refuses("t,ax [m]\n0,0\n", {"record.csv:1:3", "'m' has the wrong unit", "m/s2"});
  refuses("t,NS,UD\n0,0,0\n",
          {"record.csv:1:3", "'NS' does not say which component", "end its name in x or y"});
  refuses("t,az\n0,0\n", {"record.csv:1:3", "'az'"});
  refuses("t;ax;ay\n0;0;0\n", {"record.csv:1:1", "';' separates", "write commas"});
  refuses("t\tax\n0\t0\n", {"record.csv:1:1", "tabs separate", "write commas"});
  refuses("t,ax,ax\n0,0,0\n", {"record.csv:1:6", "'ax' stands twice"});
  refuses("0,1,2\n1,2,3\n", {"record.csv:1:1", "no names", "header"});
  refuses("t,ax,ay\n", {"record.csv:1:1", "no entries"});
  refuses("t,ax,ay,az\n", {"4 columns"});
  const std::string missing = problem_of("[[quake]]\nacceleration = \"none.csv\"\n");
  EXPECT_NE(missing.find("cannot be read"), std::string::npos) << missing;
}

TEST_F(ActionsInTime, AHistoryWithoutAFileNameOrEntriesIsRefusedWhereItIsWritten) {
  const std::string load = "[[load]]\ntype = \"body\"\nblock = 0\n",
                    quiet = "[[quiet_boundary]]\non = [[0, 0], [1, 0]]\n";
  for (const auto& [table, key] : {std::pair{std::string(support), "history"},
                                   {support, "velocity_history"},
                                   {support, "acceleration_history"},
                                   {load, "history"},
                                   {quiet, "incoming"},
                                   {"[[quake]]\n", "acceleration"}}) {
    const std::string more = table + key + " = ";
    const auto line = std::ranges::count(std::string(minimal) + more, '\n') + 1;
    const std::string place = "scene.toml:" + std::to_string(line) + ':' +
                              std::to_string(std::string_view(key).size() + 4) + ": error: '" + key + "' ";
    const std::string nameless = problem_of(more + "\"\"\n");
    EXPECT_TRUE(nameless.starts_with(place)) << nameless;
    EXPECT_NE(nameless.find("names no file (write the path of a file"), std::string::npos) << nameless;
    const std::string empty = problem_of(more + "[]\n");
    EXPECT_TRUE(empty.starts_with(place)) << empty;
    EXPECT_NE(empty.find("expected [[t, x, y], ...]"), std::string::npos) << empty;
  }
}

TEST_F(ActionsInTime, AMotionAlongAnAxisThatIsNotHeldIsRefused) {
  write("record.csv", "t,x,y\n0,0,0\n1,0,0\n2,0,0.1\n");
  write("still.csv", "t,x,y\n0,0,0\n1,0.1,0\n2,0,0\n");
  const std::string along_x = support + std::string("axes = \"x\"\n");
  const auto line = std::ranges::count(std::string(minimal) + along_x, '\n') + 1;
  for (const std::string key :
       {"displacement", "velocity", "history", "velocity_history", "acceleration_history"}) {
    const bool in_time = key.ends_with("history");
    const std::string problem = problem_of(along_x + key + (in_time ? " = \"record.csv\"\n" : " = [0, 1]\n"));
    EXPECT_TRUE(problem.starts_with("scene.toml:" + std::to_string(line) + ':')) << problem;
    EXPECT_NE(
        problem.find("error: '" + key +
                     "' moves vertices in y, which 'axes' leaves free (write 0 for y, or axes = \"xy\")"),
        std::string::npos)
        << problem;
    EXPECT_TRUE(read_scene(along_x + key + (in_time ? " = \"still.csv\"\n" : " = [1, 0]\n")).problems.empty())
        << key;
  }
  const std::string problem =
      problem_of(support + std::string("axes = \"y\"\nhistory = [[0, 0, 0], [1, 1, 0]]\n"));
  EXPECT_NE(problem.find("moves vertices in x"), std::string::npos) << problem;
}

TEST_F(ActionsInTime, CoarseRecordsAreWarnedOf) {
  std::ostringstream coarse, fine;
  coarse << "t,ax\n";
  fine << "t,ax\n";
  for (int k = 0; k < 100; ++k) coarse << 0.05 * k << ',' << std::sin(1.5 * k) << '\n';
  for (int k = 0; k < 100; ++k) fine << 0.05 * k << ',' << std::sin(0.3 * k) << '\n';
  write("record.csv", fine.str());
  EXPECT_TRUE(read_scene(quake).problems.empty());
  write("record.csv", coarse.str());
  const std::string problem = problem_of(quake);
  EXPECT_NE(problem.find("warning: 'acceleration' is sampled coarsely"), std::string::npos) << problem;
  for (const std::string key : {"velocity_history", "acceleration_history"}) {
    const std::string of_support = problem_of(support + key + " = \"record.csv\"\n");
    EXPECT_NE(of_support.find("'" + key + "' is sampled coarsely"), std::string::npos) << of_support;
  }
}

TEST_F(ActionsInTime, APressureMayHaveAnyNameAndComponentsEitherCase) {
  for (const std::string name : {"p", "load", "px", "py"}) {
    write("record.csv", "t [s], " + name + " [kPa]\n0, 1\n1, 100\n");
    const Scene scene =
        scene_with_more("[[load]]\ntype = \"pressure\"\nblock = 0\nedge = 0\nhistory = \"record.csv\"\n");
    ASSERT_EQ(scene.loads.size(), 1u);
    EXPECT_EQ(scene.loads[0].force.at(1, 1).x(), 100e3) << name;
  }
  write("record.csv", "t, AX, AY\n0, 1, 2\n1, 3, 4\n");
  EXPECT_EQ(scene_with_more(quake).quakes[0].acceleration.at(1, 1), Vec2(3, 4));
}

TEST_F(ActionsInTime, MissingRowsAreWarnedOf) {
  std::ostringstream record;
  record << "t,ax\n";
  for (int k = 0; k < 60; ++k)
    if (k != 20 && k != 21 && k != 40) record << 0.01 * k << ',' << std::sin(0.3 * k) << '\n';
  write("record.csv", record.str());
  const std::string problem = problem_of(quake);
  EXPECT_NE(problem.find("record.csv:22:1: warning: rows may be missing: this one comes 0.03 s after the one "
                         "before, most come after 0.01 s (2 such gaps in all)"),
            std::string::npos)
      << problem;
  write("record.csv", "t,ax\n0,0\n0.1,1\n0.2,0\n5,0\n");
  EXPECT_TRUE(read_scene(quake).problems.empty());
}

TEST_F(ActionsInTime, RecordsAreNotedWithTheirPeakAndTheEndsOfTheirIntegrals) {
  const std::string entries = "[[0, 0, 0], [1, 2, 0], [2, 2, 0], [3, 2, 0], [4, 0, 0]]\n";
  for (const std::string& record :
       {"[[quake]]\nacceleration = " + entries, support + ("acceleration_history = " + entries)}) {
    const auto notes = ddacontact::scene_format::notes_on_records(scene_with_more(record));
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_NE(
        notes[0].find(": 5 entries from t = 0 to 4 s, the largest acceleration (2, 0) m/s2 at t = 1 s; its "
                      "baseline is not corrected: it ends with the velocity (6, 0) m/s and the displacement "
                      "(12, 0) m"),
        std::string::npos)
        << notes[0];
  }
}

TEST_F(ActionsInTime, WaterIsReadAndWritten) {
  const std::string stages =
      "[[stage]]\nsteps = 1\n[[stage]]\nsteps = 1\nwater = { table = [[0, 3]], density = 1025 }\n"
      "[[stage]]\nsteps = 1\nwater = { joints = false }\n";
  const Scene scene = scene_with_more(
      "[water]\ntable = [[0, 2], [\"500 cm\", 1]]\njoint_table = [[0, 2], [5, 0]]\n" + stages);
  EXPECT_EQ(scene.water.table(0, 1), 5);
  EXPECT_EQ(scene.stages[0].water, scene.water);
  EXPECT_EQ(scene.stages[1].water.table(1, 0), 3);
  EXPECT_EQ(scene.stages[1].water.joint_table(1, 1), 0);
  EXPECT_EQ(scene.stages[1].water.density, 1025);
  EXPECT_EQ(scene.stages[2].water.joint_table.cols(), 0);
  const Scene again = scene_of(written(scene));
  EXPECT_EQ(again.water, scene.water);
  for (std::size_t s = 0; s < 3; ++s) EXPECT_EQ(again.stages[s].water, scene.stages[s].water) << s;
}

TEST_F(ActionsInTime, WaterIsRefusedWithACure) {
  EXPECT_NE(problem_of("[water]\ndensity = 1000\n").find("without 'table'"), std::string::npos);
  EXPECT_NE(problem_of("[water]\ntable = [[0, 1], [2, 1], [1, 0]]\n").find("turns back at x = 1 m"),
            std::string::npos);
  EXPECT_NE(problem_of("[water]\ntable = []\n").find("no points"), std::string::npos);
  EXPECT_NE(problem_of("[[stage]]\nsteps = 1\ngravity = [2, -9]\nwater = { table = [[0, 1]] }\n")
                .find("warning: gravity is inclined"),
            std::string::npos);
  EXPECT_NE(problem_of("[water]\ntable = [[0, 1]]\ndensity = \"3 kN/m3\"\n").find("wrong unit"),
            std::string::npos);
}

TEST_F(ActionsInTime, QuietBoundariesAreFoundWrittenAndRefused) {
  const std::string on = "[[quiet_boundary]]\non = [[-1, 0], [2, 0]]\n";
  const Scene scene = scene_with_more(on + "incoming = [[0, 0, 0], [1, 0, 0.1]]\n"),
              again = scene_of(written(scene));
  for (const Scene* one : {&scene, &again}) {
    ASSERT_EQ(one->quiet_boundaries.size(), 1u);
    ASSERT_EQ(one->quiet_boundaries[0].faces.size(), 1u);
    EXPECT_EQ(one->quiet_boundaries[0].faces[0].edge, 0);
    EXPECT_EQ(one->quiet_boundaries[0].incoming.at(0.5, 1), Vec2(0, 0.05));
  }
  EXPECT_NE(problem_of(on + "[[support]]\nblock = 0\nvertices = [0, 1]\n").find("quiet and held in x"),
            std::string::npos);
  EXPECT_NE(problem_of("[[quiet_boundary]]\non = [[5, 5], [6, 6]]\n").find("no edge lies on the line"),
            std::string::npos);
  EXPECT_NE(problem_of("[[quiet_boundary]]\non = [[5, 5]]\n").find("[[x, y], [x, y]]"), std::string::npos);
}

}  // namespace
