// `dda plot` and `dda info` from outside: what they write and say, and what they refuse.

#include "program.hpp"

#include <pugixml.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace {

using namespace support;

/// With a result: ten steps of the arch.
class Results : public Program {
 protected:
  Results() {
    const std::string scene = "'" POLYDDA_EXAMPLES "/paper/arch_friction30.toml'";
    EXPECT_EQ(dda("run " + scene + " -o result --steps 10 --quiet --set output.every=5"), 0) << err_;
  }

  std::string svg(const std::string& name) const {
    const std::string text = read_file(directory_ / name);
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(text.c_str())) << name;
    return text;
  }
  void expect_refused(const std::string& arguments, int status, const std::vector<std::string>& told) {
    EXPECT_EQ(dda(arguments), status) << arguments;
    EXPECT_EQ(err_.rfind("dda: error: ", 0), 0u) << err_;
    EXPECT_EQ(std::count(err_.begin(), err_.end(), '\n'), 1) << err_;
    for (const std::string& words : told)
      EXPECT_NE(err_.find(words), std::string::npos) << words << ": " << err_;
    EXPECT_FALSE(fs::exists(directory_ / "x.svg"));
  }
};

TEST_F(Results, AreDrawn) {
  ASSERT_EQ(dda("plot result -o a.svg"), 0) << err_;
  EXPECT_TRUE(out_.empty());
  EXPECT_NE(svg("a.svg").find("step 10, t = 0.1 s"), std::string::npos);
  EXPECT_NE(svg("a.svg").find("Arch bridge"), std::string::npos);
  for (const char* field :
       {"sxx", "syy", "sxy", "s1", "s2", "displacement", "velocity", "material", "block", "none"})
    EXPECT_EQ(dda(std::string("plot result --field ") + field + " -o a.svg"), 0) << err_;
}

TEST_F(Results, AreDrawnInPanelsWithAllThatGoesOnTop) {
  ASSERT_EQ(dda("plot result result --field s1,displacement --field syy --frame 5,last --reference --forces "
                "--crosses "
                "--vectors velocity --names --width 1200 -o b.svg"),
            0)
      << err_;
  const std::string picture = svg("b.svg");
  for (const char* words : {"result: step 5", "result: step 10", "crown", "contact force", "compression"})
    EXPECT_NE(picture.find(words), std::string::npos) << words;
  ASSERT_EQ(dda("plot result --field s1 --range '-1 kPa,2000' --window 0,1,0,1 --own-range -o c.svg"), 0)
      << err_;
  EXPECT_NE(svg("c.svg").find("clip-path"), std::string::npos);
}

TEST_F(Results, AreDrawnWithMagnifiedDisplacements) {
  ASSERT_EQ(dda("plot result --magnify 200 --reference -o m.svg"), 0) << err_;
  EXPECT_NE(svg("m.svg").find("step 10, t = 0.1 s, displacements x 200"), std::string::npos);
  ASSERT_EQ(dda("plot result --magnify 1 -o one.svg"), 0) << err_;
  ASSERT_EQ(dda("plot result -o plain.svg"), 0) << err_;
  EXPECT_EQ(svg("one.svg"), svg("plain.svg"));
  expect_refused("plot result --magnify many -o x.svg", 2, {"--magnify"});
  expect_refused("plot result --energy --magnify 2 -o x.svg", 2, {"curves"});
}

TEST_F(Results, AreDrawnAsPngAndPdf) {
  if (dda("plot result -o a.png") == 2) {  // built without librsvg
    EXPECT_NE(err_.find("librsvg2-dev"), std::string::npos) << err_;
    return;
  }
  ASSERT_EQ(dda("plot result --energy -o a.pdf"), 0) << err_;
  ASSERT_EQ(dda("plot '" POLYDDA_EXAMPLES "/paper/arch_friction30.toml' -o scene.png"), 0) << err_;
  EXPECT_EQ(read_file(directory_ / "a.png").substr(1, 3), "PNG");
  EXPECT_EQ(read_file(directory_ / "scene.png").substr(1, 3), "PNG");
  EXPECT_EQ(read_file(directory_ / "a.pdf").substr(0, 5), "%PDF-");
  EXPECT_EQ(dda("plot result -o nowhere/x.png"), 4);
  EXPECT_NE(err_.find("nowhere/x.png"), std::string::npos) << err_;
  EXPECT_EQ(dda("plot result -o nowhere/x.pdf"), 4);
}

TEST_F(Results, HaveTheirHistoriesDrawn) {
  ASSERT_EQ(dda("plot result --unbalanced -o e.svg"), 0) << err_;
  EXPECT_NE(read_file(directory_ / "e.svg").find("out of balance"), std::string::npos);
  ASSERT_EQ(dda("plot result --history ux,vy --energy -o d.svg"), 0) << err_;
  const std::string picture = svg("d.svg");
  for (const char* words : {"kinetic", "time", "mJ/m"})
    EXPECT_NE(picture.find(words), std::string::npos) << words;
  EXPECT_EQ(dda("plot result result --history y --monitor crown -o e.svg"), 0) << err_;
}

TEST_F(Program, BoltsHaveAHistoryThatEndsWithTheForcesOfTheirSegments) {
  ASSERT_EQ(dda("run '" POLYDDA_EXAMPLES "/bolted_roof.toml' -o roof --steps 12 --quiet"), 0) << err_;
  // bolt, segment, force, elongation, state of the segments at the end; of the history its last rows.
  std::map<std::string, double> largest, told;
  for (const auto& row : read_csv(directory_ / "roof/bolts.csv"))
    if (row[0] != "bolt") largest[row[0]] = std::max(largest[row[0]], std::abs(std::stod(row[4])));
  const auto history = read_csv(directory_ / "roof/bolt_history.csv");
  for (const auto& row : history)
    if (row[0] == "12") told[row[2]] = std::abs(std::stod(row[4]));
  EXPECT_EQ(told, largest);
  EXPECT_GT(largest.size(), 1u);
  EXPECT_EQ(history.size(), 1 + 13 * largest.size());

  ASSERT_EQ(dda("plot roof --bolts -o b.svg"), 0) << err_;
  EXPECT_NE(read_file(directory_ / "b.svg").find("axial force"), std::string::npos);
  ASSERT_EQ(dda("view roof -o b.html"), 0) << err_;
}

/// A block of 2 t is pushed along a floor with friction of 30 degrees.
TEST_F(Program, SupportsHaveAHistoryThatEndsWithTheirReactions) {
  write("push.toml", R"([analysis]
steps = 40
time_step = 0.01
gravity = [0, -10]
[[material]]
name = "rock"
density = 2000
young = 1e10
poisson = 0.2
[[joint]]
friction_angle = 30
[[block]]
name = "floor"
material = "rock"
vertices = [[-1, -1], [4, -1], [4, 0], [-1, 0]]
fixed = true
[[block]]
name = "pushed"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[support]]
block = "pushed"
vertices = [0, 3]
axes = "x"
velocity_history = [[0, 0.1, 0], [1, 0.1, 0]]
)");
  ASSERT_EQ(dda("run push.toml --quiet"), 0) << err_;
  const auto history = read_csv(directory_ / "push-out/support_history.csv"),
             last = read_csv(directory_ / "push-out/supports.csv");
  ASSERT_EQ(history.size(), 1 + 41u);
  double sum = 0;
  for (const auto& row : last)
    if (row[0] == "pushed") sum += std::stod(row[2]);
  EXPECT_NEAR(sum, 2e4 * std::tan(std::numbers::pi / 6), 1e-3 * sum);
  EXPECT_EQ(history.back()[2], "pushed");
  EXPECT_NEAR(std::stod(history.back()[3]), sum, 1e-9 * sum);
  EXPECT_NEAR(std::stod(history[20][3]), sum, 0.01 * sum);

  ASSERT_EQ(dda("plot push-out --reactions -o r.svg"), 0) << err_;
  EXPECT_NE(read_file(directory_ / "r.svg").find("reaction fx"), std::string::npos);
  ASSERT_EQ(dda("view push-out -o r.html"), 0) << err_;
  ASSERT_EQ(dda("run push.toml --resume push-out/checkpoint.bin -o again --quiet"), 0) << err_;
  EXPECT_EQ(read_file(directory_ / "again/support_history.csv"),
            read_file(directory_ / "push-out/support_history.csv"));
}

TEST_F(Results, AreDrawnInARangeThatNoNumberDivides) {
  EXPECT_EQ(dda("plot result --field displacement --range=1,1.0000000000000002 -o x.svg"), 0) << err_;
}

TEST_F(Results, WrongCallsAreRefusedWithACure) {
  expect_refused("plot result --bolts -o x.svg", 2, {"[[bolt]]"});
  expect_refused("plot result --reactions -o x.svg", 2, {"support_history.csv", "[[support]]"});
  expect_refused("plot", 2, {"DIR"});
  expect_refused("plot result", 2, {"--output"});
  expect_refused("plot result -o x.gif", 2, {"x.gif", ".svg, .png or .pdf"});
  expect_refused("plot result --field stress -o x.svg", 2, {"\"stress\"", "known"});
  expect_refused("plot result --field displacment -o x.svg", 2,
                 {"did you mean \"displacement\"? there are: none, sxx"});
  expect_refused("plot result --frame 7 -o x.svg", 2, {"step 7", "0, 5, 10"});
  expect_refused("plot result --frame first -o x.svg", 2, {"\"first\"", "\"last\""});
  expect_refused("plot result --vectors force -o x.svg", 2, {"velocity"});
  expect_refused("plot result --range 5 -o x.svg", 2, {"2 numbers"});
  expect_refused("plot result --range 5,1 -o x.svg", 2, {"below"});
  expect_refused("plot result --range=-1e308,1e308 -o x.svg", 2, {"--range: -1e+308 to 1e+308 is too wide"});
  expect_refused("plot result --window=0,1,-1e308,1e308 -o x.svg", 2, {"--window", "too wide"});
  expect_refused("plot result --range 1kN,2 -o x.svg", 2, {"1kN"});
  expect_refused("plot result --field block --range 1,2 -o x.svg", 2, {"--range"});
  expect_refused("plot result --window 0,1,2 -o x.svg", 2, {"4 numbers"});
  expect_refused("plot result --window 900,901,0,1 -o x.svg", 2, {"shows nothing", "in x"});
  expect_refused("plot result --history uz -o x.svg", 2, {"\"uz\"", "ux"});
  expect_refused("plot result --history ux --monitor crwn -o x.svg", 2, {"crwn", "crown"});
  expect_refused("plot result --monitor crown -o x.svg", 2, {"--history"});
  expect_refused("plot result --energy --field s1 -o x.svg", 2, {"--energy"});
  expect_refused("plot result --width 10 -o x.svg", 2, {"--width"});
  expect_refused("info", 2, {"DIR"});
}

TEST_F(Results, FilesThatAreNotThereOrDamagedEndWithStatus4) {
  fs::create_directories(directory_ / "empty");
  write("file", "text");
  expect_refused("plot missing -o x.svg", 4, {"missing"});
  expect_refused("plot empty -o x.svg", 4, {"empty", "not a result directory"});
  expect_refused("plot file -o x.svg", 4, {"is a file"});
  expect_refused("plot result -o nowhere/x.svg", 4, {"nowhere/x.svg"});
  expect_refused("info missing", 4, {"missing"});
  expect_refused("info empty", 4, {"empty"});
  write("result/summary.json", "{\"status\":");
  expect_refused("info result", 4, {"summary.json"});
  write("result/monitors.csv", "step,time\n1\n");
  expect_refused("plot result --history ux -o x.svg", 4, {"monitors.csv"});
  fs::remove(directory_ / "result/results.pvd");
  expect_refused("plot result -o x.svg", 4, {"results.pvd"});
}

TEST_F(Results, WhatARunDidNotKeepIsNamed) {
  ASSERT_EQ(dda("run '" POLYDDA_EXAMPLES "/paper/sliding_0.toml' -o bare --steps 1 --quiet --set "
                "'output.fields=[\"displacement\"]'"),
            0)
      << err_;
  expect_refused("plot bare --field s1 -o x.svg", 2, {"\"s1\"", "displacement", "[output]"});
  EXPECT_EQ(dda("plot bare -o y.svg"), 0) << err_;  // outlines, without being asked
}

TEST_F(Results, AreToldInWords) {
  ASSERT_EQ(dda("info result"), 0) << err_;
  EXPECT_NE(out_.find("from sinking weights"), std::string::npos) << out_;
  EXPECT_EQ(out_.find("at most 0"), std::string::npos) << out_;
  for (const char* words :
       {"Arch bridge", "completed after 10 steps", "7 blocks", "largest displacement", "block crown",
        "Pa in block", "12 stick", "of the smallest block's size", "into deformation", "balance closes",
        "the blocks weigh 2.412 kN/m", "wall time", "; of each block ", "detection ",
        "of the solver: analysis ", "3: steps 0, 5, 10", "monitors.csv"})
    EXPECT_NE(out_.find(words), std::string::npos) << words << "\n" << out_;
}

TEST_F(Results, AreToldAsFarAsTheyAreThere) {
  fs::remove(directory_ / "result/vertices.csv");
  fs::remove(directory_ / "result/scene.toml");
  EXPECT_EQ(dda("info result"), 4);
  EXPECT_NE(err_.find("vertices.csv"), std::string::npos) << err_;
  EXPECT_NE(out_.find("completed after 10 steps"), std::string::npos) << out_;
  EXPECT_NE(out_.find("12 stick"), std::string::npos) << out_;
}

TEST_F(Program, PlotDrawsASceneBeforeItIsRun) {
  const std::string scene = "'" POLYDDA_EXAMPLES "/paper/sliding_30.toml'";
  ASSERT_EQ(dda("plot " + scene + " --names --numbers -o scene.svg"), 0) << err_;
  const std::string picture = read_file(directory_ / "scene.svg");
  for (const char* word : {">ramp<", ">slider<", ">e2<", "joint interface", ">held<", ">monitor<"})
    EXPECT_NE(picture.find(word), std::string::npos) << word;
  EXPECT_EQ(dda("plot " + scene + " --field s1 -o scene2.svg"), 2);
  EXPECT_EQ(dda("plot " + scene + " --set block.slider.fixed=7 -o scene2.svg"), 2);
  EXPECT_FALSE(fs::exists(directory_ / "scene2.svg"));
}

TEST_F(Program, PlotNamesTheBlocksThatAreLeft) {
  const std::string scene = "'" POLYDDA_EXAMPLES "/excavation.toml'";
  ASSERT_EQ(dda("run " + scene + " -o result --quiet --steps 12"), 0) << err_;
  ASSERT_EQ(dda("plot result --names -o names.svg"), 0) << err_;
  const std::string picture = read_file(directory_ / "names.svg");
  for (const char* left : {">0-1<", ">0-4<", ">4-3<"})
    EXPECT_NE(picture.find(left), std::string::npos) << left;
  for (const char* removed : {">0-2<", ">0-3<"})
    EXPECT_EQ(picture.find(removed), std::string::npos) << removed;
}

/// The first stage of the dam has its water far below, the second one full.
TEST_F(Program, PlotDrawsTheWaterOfTheStage) {
  const std::string scene = "'" POLYDDA_EXAMPLES "/dam.toml'";
  ASSERT_EQ(dda("run " + scene + " -o result --quiet --set output.every=20"), 0) << err_;
  ASSERT_EQ(dda("plot result --frame 20 -o empty.svg"), 0) << err_;
  EXPECT_EQ(read_file(directory_ / "empty.svg").find("water table"), std::string::npos);
  ASSERT_EQ(dda("plot result --frame 40 --thrust -o full.svg"), 0) << err_;
  const std::string full = read_file(directory_ / "full.svg");
  for (const char* words : {">water table<", ">water table of joints<", ">line of thrust<"})
    EXPECT_NE(full.find(words), std::string::npos) << words;
  EXPECT_EQ(dda("plot " + scene + " --thrust -o scene.svg"), 2);
}

}  // namespace
