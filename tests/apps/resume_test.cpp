// Runs that are interrupted, killed or run out of room, and what goes on from their checkpoints.

#include "resumed_program.hpp"

#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <random>
#include <set>
#include <thread>

namespace {

using namespace support;

/// A beam on two pillars: it settles, one pillar is taken out, it turns down and lands.
constexpr char staged_scene[] = R"(format = 1
[analysis]
time_step = 0.01
max_displacement_ratio = 1.0
block_model = "wachspress"
[[material]]
name = "rock"
density = 2500
young = "35 GPa"
poisson = 0.3
[[joint]]
name = "interface"
friction_angle = 20
cohesion = "1 kPa"
[[block]]
name = "base"
material = "rock"
vertices = [[-10, -1], [10, -1], [10, 0], [-10, 0]]
fixed = true
[[block]]
name = "left"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[block]]
name = "pillar"
material = "rock"
vertices = [[4, 0], [5, 0], [5, 1], [4, 1]]
[[block]]
name = "beam"
material = "rock"
vertices = [[0, 1], [5, 1], [5, 2], [0, 2]]
[[monitor]]
name = "tip"
block = "beam"
vertex = 1
[[stage]]
name = "settle"
mode = "static"
steps = 5
joints = { interface = { friction_angle = "89 deg" } }
reset_displacements = true
[[stage]]
name = "fall"
steps = 95
remove = ["pillar"]
[output]
every = 3
)";

/// A block on the ground.
constexpr char endless_scene[] = R"(format = 1
[analysis]
time_step = 0.001
steps = 100000000
[[material]]
name = "rock"
density = 2500
young = "35 GPa"
poisson = 0.3
[[joint]]
name = "interface"
friction_angle = 20
[[block]]
material = "rock"
vertices = [[-10, -1], [10, -1], [10, 0], [-10, 0]]
fixed = true
[[block]]
material = "rock"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[output]
every = 0
)";

TEST_F(Resume, AnyStepGivesTheSameFiles) {
  write("staged.toml", staged_scene);
  expect_any_step_to_do("staged.toml");
  expect_any_step_to_do(POLYDDA_EXAMPLES "/paper/sliding_30.toml");
}

/// Scenes of the paper's mechanics under the default one too.
TEST_F(Resume, AnyStepOfEveryExampleGivesTheSameFiles) {
  for (const auto& entry : fs::recursive_directory_iterator(POLYDDA_EXAMPLES)) {
    if (entry.path().extension() != ".toml") continue;
    const std::string scene = "'" + entry.path().string() + "'";
    ASSERT_NO_FATAL_FAILURE(expect_any_step_to_do(scene));
    if (scene.find("/paper/") == std::string::npos) continue;
    ASSERT_NO_FATAL_FAILURE(expect_any_step_to_do(
        scene + " --set analysis.preset=default --set analysis.block_model=wachspress"));
  }
}

TEST_F(Resume, KilledThirtyTimesAtRandomTheSameFiles) {
  write("staged.toml", staged_scene);
  ASSERT_EQ(dda("run staged.toml -o whole --quiet --set output.checkpoint_every=2"), 0) << err_;
  std::mt19937 random(1);
  int kills = 0, starts = 0, losses = 0;
  long last_step = 0;
  while (kills < 30 && starts < 120) {
    std::vector<std::string> call{
        "run", "staged.toml", "-o", "killed", "--quiet", "--set", "output.checkpoint_every=2"};
    if (fs::exists(directory_ / "killed/checkpoint.bin")) {
      call.insert(call.end(), {"--resume", "killed/checkpoint.bin"});
      const auto rows = read_csv(directory_ / "killed/energy.csv");
      const long step = std::stol(rows.back()[0].empty() ? "0" : rows.back()[0]);
      if (step + 1 < last_step) ++losses;
      last_step = step;
    }
    ++starts;
    const int status = run_and_signal(call, static_cast<int>(random() % 40), SIGKILL);
    if (status == 128 + SIGKILL) {
      ++kills;
      if (fs::exists(directory_ / "killed")) write("killed/summary.json.part1", "killed as it was written");
    } else {
      ASSERT_EQ(status, 0);
      ASSERT_NO_FATAL_FAILURE(expect_same_results("whole", "killed"));
      fs::remove_all(directory_ / "killed");
      last_step = 0;
    }
  }
  EXPECT_EQ(kills, 30);
  ASSERT_EQ(
      dda("run staged.toml -o killed --quiet --set output.checkpoint_every=2" +
          std::string(fs::exists(directory_ / "killed/checkpoint.bin") ? " --resume killed/checkpoint.bin"
                                                                       : "")),
      0)
      << err_;
  expect_same_results("whole", "killed");
}

TEST_F(Resume, ASignalLeavesACheckpoint) {
  write("staged.toml", staged_scene);
  for (const int signal : {SIGTERM, SIGINT}) {
    const int status =
        run_and_signal({"run", "staged.toml", "-o", "part", "--quiet", "--steps", "1000000"}, 400, signal);
    ASSERT_EQ(status, 128 + signal);
    const nlohmann::json stopped = summary("part");
    EXPECT_EQ(stopped["status"], "interrupted");
    const std::string steps = std::to_string(stopped["steps_completed"].get<long>() + 3);
    ASSERT_EQ(dda("run staged.toml -o part --quiet --resume part/checkpoint.bin --steps " + steps), 0)
        << err_;
    ASSERT_EQ(dda("run staged.toml -o whole --quiet --steps " + steps), 0) << err_;
    expect_same_results("whole", "part");
  }
}

TEST_F(Resume, CasesEndWithTheirSweepAndLeaveCheckpoints) {
  write("long.toml", endless_scene);
  run_and_signal({"sweep", "long.toml", "--vary", "joint.interface.friction_angle=20,30", "-o", "swept",
                  "--jobs", "1", "--quiet"},
                 1000, SIGKILL);
  const fs::path written = directory_ / "swept" / "case-1" / "summary.json";
  for (int k = 0; k < 100 && !fs::exists(written); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  ASSERT_TRUE(fs::exists(written));
  EXPECT_EQ(summary("swept/case-1")["status"], "interrupted");
  EXPECT_TRUE(fs::exists(directory_ / "swept" / "case-1" / "checkpoint.bin"));
}

/// Ctrl-C reaches the cases too, in whatever order.
TEST_F(Resume, AnInterruptedSweepSaysWhatIsFinished) {
  write("long.toml", endless_scene);
  for (const int signal : {SIGTERM, SIGINT}) {
    const int status =
        run_and_signal({"sweep", "long.toml", "--vary", "joint.interface.friction_angle=20,30,40", "-o",
                        "swept", "--jobs", "2", "--quiet"},
                       1000, signal);
    EXPECT_EQ(status, 128 + signal);
    EXPECT_EQ(summary("swept/case-1")["status"], "interrupted");
    EXPECT_EQ(summary("swept/case-2")["status"], "interrupted");
    EXPECT_FALSE(fs::exists(directory_ / "swept" / "case-3"));
    EXPECT_FALSE(fs::exists(directory_ / "swept" / "sweep.csv"));
  }
}

/// Pushed to and fro it neither rests nor moves far.
TEST_F(Resume, AnInterruptedSearchForAFactorLeavesNoAnswer) {
  std::string scene = endless_scene;
  scene.erase(scene.find("steps = "), std::string("steps = 100000000\n").size());
  scene += "[[load]]\ntype = \"point\"\nblock = 1\nat = [0.5, 0.5]\nhistory = [[0, 1e3, 0]";
  for (int k = 1; k < 4000; ++k)
    scene += ", [" + std::to_string(k / 2.) + (k % 2 == 0 ? ", 1e3, 0]" : ", -1e3, 0]");
  scene +=
      "]\n[[stage]]\nname = \"settle\"\nmode = \"static\"\nsteps = 5\n[[stage]]\nname = \"shake\"\nsteps = "
      "100000000\n";
  write("shaken.toml", scene);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(run_and_signal({"safety", "shaken.toml", "-o", "factor", "--quiet", "--jobs", "1"}, 2000, SIGINT),
            128 + SIGINT);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
  EXPECT_TRUE(fs::exists(directory_ / "factor" / "safety.csv"));
  EXPECT_FALSE(fs::exists(directory_ / "factor" / "safety.json"));
}

TEST_F(Resume, AFullDiskKeepsTheLastCheckpoint) {
  write("staged.toml", staged_scene);
  const std::string settings = " --quiet --set output.checkpoint_every=5 --set output.every=0";
  // No file may grow beyond 16 kB here: the histories do first.
  const int status = std::system(("cd '" + directory_.string() + "' && ulimit -f 32 && " +
                                  POLYDDA_PROGRAM " run staged.toml -o full" + settings + " 2> stderr")
                                     .c_str());
  EXPECT_EQ(WEXITSTATUS(status), 4);
  EXPECT_NE(read_file(directory_ / "stderr").find("cannot write"), std::string::npos);
  ASSERT_TRUE(fs::exists(directory_ / "full/checkpoint.bin"));
  ASSERT_EQ(dda("run staged.toml -o full --resume full/checkpoint.bin" + settings), 0) << err_;
  ASSERT_EQ(dda("run staged.toml -o whole" + settings), 0) << err_;
  expect_same_results("whole", "full");
}

TEST_F(Resume, OutputMayChange) {
  write("staged.toml", staged_scene);
  ASSERT_EQ(dda("run staged.toml -o part --quiet --steps 6 --set output.every=2"), 0) << err_;
  ASSERT_EQ(
      dda("run staged.toml -o part --quiet --steps 12 --set output.every=6 --resume part/checkpoint.bin"), 0)
      << err_;
  EXPECT_EQ(number_of_frames("part"), 5) << "0, 2, 4, 6 and 12";
}

TEST_F(Resume, ACheckpointAloneIsEnoughToGoOn) {
  write("staged.toml", staged_scene);
  ASSERT_EQ(dda("run staged.toml -o part --quiet --steps 6"), 0) << err_;
  fs::rename(directory_ / "part/checkpoint.bin", directory_ / "alone.bin");
  ASSERT_EQ(dda("run staged.toml -o rest --steps 12 --resume alone.bin"), 0) << err_;
  EXPECT_NE(err_.find("note: what was before step 6 is not beside alone.bin"), std::string::npos) << err_;
  ASSERT_EQ(dda("run staged.toml -o whole --quiet --steps 12"), 0) << err_;
  const std::string whole = read_file(directory_ / "whole/energy.csv"),
                    rest = read_file(directory_ / "rest/energy.csv");
  const std::string rows = rest.substr(rest.find('\n') + 1);
  EXPECT_TRUE(whole.ends_with(rows)) << "rows from step 6 on";
  EXPECT_TRUE(read_file(directory_ / "whole/vertices.csv") == read_file(directory_ / "rest/vertices.csv"));
}

/// The stage of one scene, then the other one's, are what a scene with both has; forces relax in it too.
TEST_F(Resume, ASceneGoesOnAsTheNextStage) {
  std::string both = staged_scene;
  both.insert(both.find("[output]"), "relax = 10\n");
  const std::size_t settle = both.find("[[stage]]"), fall = both.find("[[stage]]", settle + 1),
                    output = both.find("[output]");
  const std::string blocks = both.substr(0, settle), then = both.substr(fall);
  write("staged.toml", both);
  write("settle.toml", both.substr(0, fall) + both.substr(output));
  write("fall.toml", blocks + then);
  ASSERT_EQ(dda("run staged.toml -o whole --quiet"), 0) << err_;
  ASSERT_EQ(dda("run settle.toml -o first --quiet"), 0) << err_;
  const std::string go_on = "run fall.toml --quiet --as-stage --resume ";
  ASSERT_EQ(dda(go_on + "first/checkpoint.bin -o second --steps 40"), 0) << err_;
  ASSERT_EQ(dda("run second/scene.toml --quiet --resume second/checkpoint.bin -o third"), 0) << err_;
  // Supports move in the time that the first scene stated: checkpoints differ in that.
  fs::rename(directory_ / "third/checkpoint.bin", directory_ / "end.bin");
  fs::remove(directory_ / "whole/checkpoint.bin");
  expect_same_results("whole", "third");

  EXPECT_EQ(dda(go_on + "end.bin -o none"), 2);
  EXPECT_NE(err_.find("fall.toml:39:10: error: block 'pillar' is gone in \"end.bin\""), std::string::npos)
      << err_;
  std::string denser = blocks + then;
  denser.replace(denser.find("density = 2500"), 14, "density = 2600");
  write("fall.toml", denser);
  EXPECT_EQ(dda(go_on + "first/checkpoint.bin -o none"), 2);
  EXPECT_NE(err_.find("fall.toml:8:11: error: \"first/checkpoint.bin\" belongs to another scene: it has "
                      "'density = 2500.0'"),
            std::string::npos)
      << err_;
  EXPECT_NE(dda("run fall.toml --as-stage -o none"), 0);
  EXPECT_FALSE(fs::exists(directory_ / "none"));
}

/// A load that a settled block did not have: it slides as it would from rest.
TEST_F(Resume, TheNextStageMayHaveOtherLoads) {
  const std::string blocks = std::string(staged_scene, std::string(staged_scene).find("[[stage]]"));
  write("settle.toml", blocks + "[[stage]]\nmode = \"static\"\nsteps = 5\n");
  write("push.toml", blocks +
                         "[[load]]\ntype = \"point\"\nblock = \"left\"\nat = [0, 0.5]\n"
                         "force = [\"-1 MN\", 0]\n[[stage]]\nsteps = 10\n");
  ASSERT_EQ(dda("run settle.toml -o settled --quiet"), 0) << err_;
  ASSERT_EQ(dda("run push.toml -o pushed --quiet --as-stage --resume settled/checkpoint.bin"), 0) << err_;
  const nlohmann::json summary = nlohmann::json::parse(read_file(directory_ / "pushed/summary.json"));
  EXPECT_EQ(summary["steps_completed"], 15);
  EXPECT_EQ(summary["fastest_block"], "left");
  EXPECT_GT(summary["fastest"], 1);
}

/// What the scene of the checkpoint would have added later is there from the start of the next stage, or
/// comes in with that of its stages that adds it.
TEST_F(Resume, TheNextStageBringsBoltsThatHaveNotComeYet) {
  const std::string blocks =
                        std::string(staged_scene, std::string(staged_scene).find("[[stage]]")) +
                        "[[bolt]]\nname = \"tie\"\npoints = [[0.5, 0.5], [0.5, -0.5]]\narea = \"4 cm2\"\n"
                        "young = \"200 GPa\"\npretension = \"10 kN\"\n",
                    stage = "[[stage]]\nmode = \"static\"\nsteps = 5\n", add = "add = [\"tie\"]\n";
  write("settle.toml", blocks + stage + stage + add);
  ASSERT_EQ(dda("run settle.toml -o settled --quiet --steps 5"), 0) << err_;
  for (const std::string& text : {stage, stage + add}) {
    write("next.toml", blocks + text);
    ASSERT_EQ(dda("run next.toml -o next --quiet --force --as-stage --resume settled/checkpoint.bin"), 0)
        << err_;
    const auto rows = read_csv(directory_ / "next/bolts.csv");
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_NEAR(std::stod(rows[1][4]), 10e3, 100);
  }
  EXPECT_EQ(dda("run next.toml -o none --quiet --as-stage --resume next/checkpoint.bin"), 2);
  EXPECT_NE(err_.find("bolt 'tie' is there"), std::string::npos) << err_;
}

TEST_F(Resume, RefusesWhatIsNoCheckpointOfTheScene) {
  write("staged.toml", staged_scene);
  ASSERT_EQ(dda("run staged.toml -o part --quiet --steps 50"), 0) << err_;
  const std::string good = read_file(directory_ / "part/checkpoint.bin");
  const auto refused = [&](int status, const std::string& settings, const std::string& words) {
    EXPECT_EQ(dda("run staged.toml -o none --resume c.bin " + settings), status) << words;
    EXPECT_NE(err_.find(words), std::string::npos) << err_;
    EXPECT_FALSE(fs::exists(directory_ / "none"));
  };
  refused(4, "", "cannot read \"c.bin\"");
  write("c.bin", staged_scene);
  refused(4, "", "\"c.bin\" is not a checkpoint");
  write("c.bin", "");
  refused(4, "", "\"c.bin\" is not a checkpoint");
  std::mt19937 random(2);
  for (int k = 0; k < 20; ++k) {
    std::string damaged = good;
    damaged[60 + random() % (good.size() - 60)] ^= static_cast<char>(1 << random() % 8);
    write("c.bin", damaged);
    refused(4, "", "\"c.bin\" is damaged");
    write("c.bin", good.substr(0, 60 + random() % (good.size() - 60)));
    refused(4, "", "\"c.bin\" is damaged");
  }
  std::string newer = good;
  newer[std::string("polydda checkpoint ").size()] = 77;
  write("c.bin", newer);
  refused(4, "", "\"c.bin\" has version 77");

  write("c.bin", good);
  std::string other = staged_scene;
  other.replace(other.find("density = 2500"), 14, "density = 2600");
  write("staged.toml", other);
  refused(2, "", "staged.toml:8:11: error: \"c.bin\" belongs to another scene: it has 'density = 2500.0'");
  write("staged.toml", staged_scene);
  refused(2, "--set stage.settle.steps=6", "staged.toml:39:9: error:");
  refused(2, "--set stage.settle.steps=6", "has made 5 steps of stage 0, which is over, not '6'");
  refused(2, "--set stage.fall.time_step=0.02", "belongs to another scene");
  refused(2, "--set solver.skip.sleep=false", "belongs to another scene");
  EXPECT_EQ(dda("run staged.toml -o more --quiet --resume c.bin --set stage.fall.steps=50"), 0) << err_;
  EXPECT_EQ(summary("more")["steps_completed"], 55);
}

TEST_F(Resume, ThroughALinkOrFromACopyKeepsWhatThereIs) {
  write("staged.toml", staged_scene);
  ASSERT_EQ(dda("run staged.toml -o whole --quiet --steps 12"), 0) << err_;
  ASSERT_EQ(dda("run staged.toml -o part --quiet --steps 6"), 0) << err_;
  fs::create_symlink("part/checkpoint.bin", directory_ / "link.bin");
  ASSERT_EQ(dda("run staged.toml -o part --quiet --steps 9 --resume link.bin"), 0) << err_;
  fs::create_directory(directory_ / "safe");
  fs::copy(directory_ / "part/checkpoint.bin", directory_ / "safe/checkpoint.bin");
  ASSERT_EQ(dda("run staged.toml -o part --quiet --steps 12 --resume safe/checkpoint.bin"), 0) << err_;
  expect_same_results("whole", "part");
}

TEST_F(Resume, AStageThatEndedWithAResetCannotGetLonger) {
  write("staged.toml", staged_scene);
  ASSERT_EQ(dda("run staged.toml -o part --quiet --steps 5"), 0) << err_;
  EXPECT_EQ(dda("run staged.toml -o part --quiet --resume part/checkpoint.bin --set stage.settle.steps=8"),
            2);
  EXPECT_NE(err_.find("has made 5 steps of stage 0, which is over, not '8'"), std::string::npos) << err_;
  ASSERT_EQ(dda("run staged.toml -o part --quiet --steps 4"), 0) << err_;
  EXPECT_EQ(dda("run staged.toml -o part --quiet --steps 6 --resume part/checkpoint.bin --set "
                "stage.settle.steps=8"),
            0)
      << err_;
}

TEST_F(Resume, WhatCannotBeWrittenAtTheEndLeavesTheRest) {
  write("staged.toml", staged_scene);
  fs::create_directories(directory_ / "result/checkpoint.bin/in_the_way");
  EXPECT_EQ(dda("run staged.toml -o result --quiet --force --steps 3"), 4);
  EXPECT_NE(err_.find("checkpoint.bin"), std::string::npos) << err_;
  EXPECT_EQ(summary("result")["status"], "completed");
  EXPECT_TRUE(fs::exists(directory_ / "result/vertices.csv"));
  EXPECT_NE(read_file(directory_ / "result/log.txt").find("cannot write"), std::string::npos);
}

TEST_F(Resume, ARunThatIsKilledLeavesNoOtherRunsEnd) {
  write("staged.toml", staged_scene);
  ASSERT_EQ(dda("run staged.toml -o result --quiet --steps 3"), 0) << err_;
  run_and_signal({"run", "staged.toml", "-o", "result", "--quiet", "--steps", "1000000"}, 300, SIGKILL);
  EXPECT_FALSE(fs::exists(directory_ / "result/summary.json"));
  EXPECT_FALSE(fs::exists(directory_ / "result/checkpoint.bin"));
}

TEST_F(Resume, AMissingPlaceForResultsIsAFileError) {
  write("staged.toml", staged_scene);
  write("file", "");
  EXPECT_EQ(dda("run staged.toml -o file/results --steps 1"), 4);
  EXPECT_EQ(dda("run staged.toml -o /proc/results --steps 1"), 4);
}

TEST_F(Resume, NothingLeftToDoWritesTheSameResults) {
  write("staged.toml", staged_scene);
  ASSERT_EQ(dda("run staged.toml -o whole --quiet --steps 20"), 0) << err_;
  ASSERT_EQ(dda("run staged.toml -o again --quiet --steps 20 --resume whole/checkpoint.bin"), 0) << err_;
  expect_same_results("whole", "again");
}

}  // namespace
