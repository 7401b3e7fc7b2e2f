// `dda sweep`: its table, cases that fail, finished cases, job arrays.

#include "program.hpp"

#include <cmath>
#include <numbers>

namespace {

using namespace support;

const std::string slope = "'" POLYDDA_EXAMPLES "/paper/sliding_30.toml'";

TEST_F(Program, SweepWritesARowPerCase) {
  ASSERT_EQ(dda("sweep " + slope +
                " --vary joint.0.friction_angle=0:30:3 --outcome vx=monitor.slider.vx --outcome "
                "steps=steps_completed --curve joint.0.friction_angle,vx --jobs 2 -o result"),
            0)
      << err_;
  const auto rows = read_csv(directory_ / "result/sweep.csv");
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0], (std::vector<std::string>{"case", "joint.0.friction_angle", "status", "steps_completed",
                                               "time", "max_displacement", "kinetic", "wall_seconds", "vx",
                                               "steps", "reason"}));
  for (std::size_t k = 1; k < 4; ++k) {
    const double phi = 15.0 * static_cast<double>(k - 1), root = std::sqrt(0.5);
    const double speed = 9.8 * 0.7 * root * (1 - std::tan(phi * std::numbers::pi / 180));
    EXPECT_EQ(rows[k][0], std::to_string(k));
    EXPECT_EQ(rows[k][2], "completed");
    EXPECT_NEAR(std::stod(rows[k][8]), speed * root, 1e-3);
    EXPECT_EQ(rows[k][9], "35");
  }
  EXPECT_NE(read_file(directory_ / "result/sweep.svg").find("</svg>"), std::string::npos);

  EXPECT_EQ(dda("info result"), 4);
  EXPECT_NE(err_.find("holds a sweep, in \"sweep.csv\""), std::string::npos) << err_;
  EXPECT_EQ(dda("info result/case-1"), 0) << err_;
}

TEST_F(Program, SweepDrawsAMapOfTwoSettings) {
  const std::string call =
      "sweep " + slope +
      " --vary joint.0.friction_angle=95,20,30 --vary analysis.steps=2,4 --quiet -o result"
      " --map joint.0.friction_angle,analysis.steps,";
  ASSERT_EQ(dda(call + "time"), 0) << err_;
  const std::string map = read_file(directory_ / "result/map.svg");
  for (const char* text :
       {">0.04<", ">0.08<", ">20<", ">30<", ">95<", ">failed<", ">joint.0.friction_angle<"})
    EXPECT_NE(map.find(text), std::string::npos) << text;
}

TEST_F(Program, SweepDrawsACurveForEachOfTheOtherSettings) {
  ASSERT_EQ(dda("sweep " + slope +
                " --vary joint.0.friction_angle=10,20 --vary analysis.steps=2,4 --quiet -o result"
                " --curve joint.0.friction_angle,max_displacement"),
            0)
      << err_;
  const std::string curves = read_file(directory_ / "result/sweep.svg");
  for (const char* text : {">analysis.steps=2<", ">analysis.steps=4<"})
    EXPECT_NE(curves.find(text), std::string::npos) << text;
}

TEST_F(Program, SweepWarnsOfAnOutcomeThatNoResultHas) {
  ASSERT_EQ(dda("sweep " + slope + " --vary analysis.steps=2 --quiet -o result --outcome u=monitor.none.ux"),
            0);
  EXPECT_NE(err_.find("outcome \"u\" is empty: no result has \"monitor.none.ux\""), std::string::npos)
      << err_;
}

TEST_F(Program, SweepGoesOnWhenACaseFailsAndSaysWhy) {
  ASSERT_EQ(
      dda("sweep " + slope + " --vary joint.0.friction_angle=95,20 --set analysis.steps=2 -o result --quiet"),
      0)
      << err_;
  const auto rows = read_csv(directory_ / "result/sweep.csv");
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[1][2], "failed");
  for (std::size_t column = 3; column < 8; ++column) EXPECT_EQ(rows[1][column], "") << rows[0][column];
  EXPECT_NE(read_file(directory_ / "result/sweep.csv").find("out of range"), std::string::npos);
  EXPECT_EQ(rows[2][2], "completed");
}

/// Not the warning that its log begins with.
TEST_F(Program, SweepSaysWhichErrorACaseHas) {
  write("unused.toml",
        "parameters = { angle = 20.0 }\n" + read_file(POLYDDA_EXAMPLES "/paper/sliding_30.toml"));
  ASSERT_EQ(
      dda("sweep unused.toml --vary joint.0.friction_angle=95,20 --set analysis.steps=2 -o result --quiet"),
      0)
      << err_;
  const std::string table = read_file(directory_ / "result/sweep.csv");
  EXPECT_NE(table.find("out of range"), std::string::npos) << table;
  EXPECT_EQ(table.find("is not used"), std::string::npos) << table;
}

TEST_F(Program, SweepSaysHowACaseEndedThatCouldNotSayIt) {
  // A second of the processor is too little.
  const int status = std::system(("cd '" + directory_.string() + "' && ulimit -t 1 && " + POLYDDA_PROGRAM +
                                  " sweep " + slope +
                                  " --vary joint.0.friction_angle=20,21 -o result "
                                  "--set analysis.steps=100000000 --set output.every=0 2> problem")
                                     .c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  const std::string problem = read_file(directory_ / "problem");
  for (const char* words : {"case 1: failed: ended by signal ", "no case could be run: ended by signal "})
    EXPECT_NE(problem.find(words), std::string::npos) << problem;
  EXPECT_NE(read_file(directory_ / "result/sweep.csv").find("ended by signal"), std::string::npos);
}

TEST_F(Program, SweepRunsFinishedCasesNotAgain) {
  const std::string call =
      "sweep " + slope + " --set analysis.steps=2 -o result --vary joint.0.friction_angle=";
  ASSERT_EQ(dda(call + "10,20"), 0) << err_;
  const auto first = fs::last_write_time(directory_ / "result/case-1/summary.json");
  ASSERT_EQ(dda(call + "10,25"), 0) << err_;
  EXPECT_NE(err_.find("1 of 2 cases to run"), std::string::npos) << err_;
  EXPECT_EQ(fs::last_write_time(directory_ / "result/case-1/summary.json"), first);
  EXPECT_EQ(read_csv(directory_ / "result/sweep.csv")[2][1], "25");
}

TEST_F(Program, SweepWritesAJobArrayThatRunsItsCases) {
  write("cases.csv", "joint.0.friction_angle,analysis.steps\n10,2\n20,3\n");
  const std::string call = "sweep " + slope + " --table cases.csv -o result";
  ASSERT_EQ(dda(call + " --slurm"), 0) << err_;
  const std::string script = read_file(directory_ / "result/sweep.sbatch");
  EXPECT_NE(script.find("--array=1-2\n"), std::string::npos) << script;
  EXPECT_FALSE(fs::exists(directory_ / "result/case-1"));
  ASSERT_EQ(dda(call + " --case 2 --quiet"), 0) << err_;
  EXPECT_FALSE(fs::exists(directory_ / "result/case-1"));
  EXPECT_EQ(summary("result/case-2")["steps_completed"], 3);
}

TEST_F(Program, SweepNoticesChangedFilesOfTheScene) {
  write("blocks.wkt", "POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0))\n");
  write("scene.toml",
        "format = 1\nblocks = \"blocks.wkt\"\n[analysis]\nsteps = 2\ntime_step = 0.01\n"
        "[[material]]\nname = \"rock\"\ndensity = 2500\nyoung = 5e9\npoisson = 0.25\n");
  const std::string call = "sweep scene.toml -o result --vary analysis.time_step=0.01,0.02";
  ASSERT_EQ(dda(call), 0) << err_;
  ASSERT_EQ(dda(call), 0) << err_;
  EXPECT_NE(err_.find("0 of 2 cases to run"), std::string::npos) << err_;
  write("blocks.wkt", "POLYGON ((0 0, 2 0, 2 1, 0 1, 0 0))\n");
  ASSERT_EQ(dda(call), 0) << err_;
  EXPECT_NE(err_.find("2 of 2 cases to run"), std::string::npos) << err_;
  write("wide.wkt", "POLYGON ((0 0, 3 0, 3 1, 0 1, 0 0))\n");
  const std::string varied = "sweep scene.toml -o varied --vary blocks=blocks.wkt,wide.wkt";
  ASSERT_EQ(dda(varied), 0) << err_;
  write("wide.wkt", "POLYGON ((0 0, 4 0, 4 1, 0 1, 0 0))\n");
  ASSERT_EQ(dda(varied), 0) << err_;
  EXPECT_NE(err_.find("1 of 2 cases to run"), std::string::npos) << err_;
}

/// The block of the example slides where tan(friction angle) < F tan 45.
TEST_F(Program, SweepFindsFactorsOfSafetyAndTheProbabilityOfFailure) {
  const std::string call = "sweep " + slope +
                           " --safety --tolerance 0.02 --set analysis.preset=default --vary "
                           "joint.0.friction_angle=40,50,0 --outcome first=first_block -o result";
  ASSERT_EQ(dda(call), 0) << err_;
  const auto rows = read_csv(directory_ / "result/sweep.csv");
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0],
            (std::vector<std::string>{"case", "joint.0.friction_angle", "status", "steps_completed", "time",
                                      "max_displacement", "kinetic", "wall_seconds", "factor_low",
                                      "factor_high", "rounded_corners", "first", "reason"}));
  for (const std::size_t k : {1u, 2u}) {
    const double exact = std::tan(std::stod(rows[k][1]) * std::numbers::pi / 180);
    EXPECT_EQ(rows[k][2], "completed");
    EXPECT_GT(std::stod(rows[k][3]), 0);
    EXPECT_NEAR(std::stod(rows[k][8]), exact, 0.03 * exact);
    EXPECT_NEAR(std::stod(rows[k][9]), exact, 0.03 * exact);
    EXPECT_EQ(rows[k][10], "rests");
    EXPECT_EQ(rows[k][11], "slider");
  }
  EXPECT_EQ(rows[3][2], "failed");
  EXPECT_NE(out_.find("probability of failure (factor below 1): 1 of 2 cases, 0.5 +- 0.35"),
            std::string::npos)
      << out_;
  EXPECT_NE(read_file(directory_ / "result/factors.svg").find("</svg>"), std::string::npos);
  ASSERT_EQ(dda(call), 0) << err_;
  EXPECT_NE(err_.find("1 of 3 cases to run"), std::string::npos) << err_;
  ASSERT_EQ(dda(call + " --slurm"), 0) << err_;
  EXPECT_NE(read_file(directory_ / "result/sweep.sbatch").find("--safety '--tolerance' '0.02'"),
            std::string::npos);
}

TEST_F(Program, SweepRefusesWrongCalls) {
  for (const auto& [arguments, word] :
       {std::pair{"", "nothing varies"}, std::pair{"--vary a", "PATH=a,b,c"},
        std::pair{"--vary a=1,2 --vary a=3", "twice"},
        std::pair{"--vary a=1,2 --case 3", "there are 2 cases"},
        std::pair{"--vary a=1,2 --case 2 --slurm", "--case and --slurm exclude each other"},
        std::pair{"--vary a=1 --outcome b", "NAME=PATH"}, std::pair{"--vary a=1 --curve b", "X,Y"},
        std::pair{"--vary a=1 --map a,b", "X,Y,VALUE"},
        std::pair{"--vary a=1 --map a,time,kinetik", "no column \"kinetik\" (did you mean \"kinetic\"?"},
        std::pair{"--vary a=1 --curve b,time", "no column \"b\""},
        std::pair{"--vary a=1 --range 1:2", "--safety"},
        std::pair{"--vary a=1 --set a=2", "'a' is set and varied"},
        std::pair{"--vary a=1 --outcome status=time", "has a column \"status\""},
        std::pair{"--vary a=1 --outcome a=time", "has a column \"a\""},
        std::pair{"--vary a=1 --outcome b=time --outcome b=kinetic", "has a column \"b\""},
        std::pair{"--vary joint.0.friction_angle=95,96", "no case could be run"},
        std::pair{"--vary no.such=1 --quiet", "no case could be run"}}) {
    EXPECT_EQ(dda("sweep " + slope + " -o result " + arguments), 2) << arguments;
    EXPECT_NE(err_.find(word), std::string::npos) << err_;
    EXPECT_FALSE(fs::exists(directory_ / "result")) << arguments;
  }
}

}  // namespace
