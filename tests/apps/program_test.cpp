// The program from outside: what it prints, what it writes, what its exit status says.

#include "program.hpp"

#include <algorithm>
#include <csignal>

namespace {

using namespace support;

const std::string arch = "'" POLYDDA_EXAMPLES "/paper/arch_friction30.toml'";
const std::string sliding = "'" POLYDDA_EXAMPLES "/paper/sliding_30.toml'";

TEST_F(Program, RunWritesEveryResultFile) {
  ASSERT_EQ(dda("run " + arch + " -o result --steps 10"), 0) << err_;
  for (const char* name :
       {"summary.json", "monitors.csv", "blocks.csv", "vertices.csv", "contacts.csv", "supports.csv",
        "energy.csv", "results.pvd", "contacts.pvd", "scene.toml", "log.txt"})
    EXPECT_TRUE(fs::exists(directory_ / "result" / name)) << name;
  EXPECT_EQ(number_of_frames("result"), 11);
  EXPECT_NE(out_.find("results in result"), std::string::npos) << out_;
  EXPECT_NE(err_.find("step 10/10"), std::string::npos) << err_;
}

TEST_F(Program, TablesHaveTheContractsColumnsAndRows) {
  ASSERT_EQ(dda("run " + arch + " -o result --steps 10 --quiet"), 0);
  const auto header = [&](const char* name) {
    const std::string text = read_file(directory_ / "result" / name);
    return text.substr(0, text.find('\n'));
  };
  EXPECT_EQ(header("monitors.csv"), "step,time,monitor,x,y,ux,uy,vx,vy");
  EXPECT_EQ(
      header("energy.csv"),
      "step,time,kinetic,elastic,gravity,friction_dissipated,numerical_dissipated,external,balance_error,"
      "damping_dissipated,pushed_out,plastic_dissipated,unbalanced,fastest");
  EXPECT_EQ(header("supports.csv"), "block,vertex,fx,fy");
  EXPECT_EQ(
      header("blocks.csv"),
      "block,model,vertices,x,y,area,area_ratio,rotation_deg,vx,vy,sxx_mean,sxx_min,sxx_max,syy_mean,syy_min,"
      "syy_max,sxy_mean,sxy_min,sxy_max,s1_max,s2_min,omega,cells,unknowns,reason");
  EXPECT_EQ(header("vertices.csv"), "block,vertex,x,y,ux,uy,vx,vy");
  EXPECT_EQ(header("contacts.csv"), "block_a,vertex,block_b,edge,state,gap,normal_force,shear_force,joint");
  EXPECT_EQ(read_csv(directory_ / "result/monitors.csv").size(), 1u + 11u);
  EXPECT_EQ(read_csv(directory_ / "result/energy.csv").size(), 1u + 11u);
  EXPECT_EQ(read_csv(directory_ / "result/blocks.csv").size(), 1u + 7u);
  EXPECT_EQ(read_csv(directory_ / "result/vertices.csv").size(), 1u + 28u);
  EXPECT_EQ(read_csv(directory_ / "result/supports.csv").size(), 1u + 4u);
  EXPECT_EQ(read_csv(directory_ / "result/contacts.csv").size(), 1u + 12u);
}

TEST_F(Program, SummarySaysWhatHappened) {
  ASSERT_EQ(dda("run " + arch + " -o result --steps 10 --quiet"), 0);
  EXPECT_TRUE(out_.empty() && err_.empty());
  const nlohmann::json s = summary("result");
  EXPECT_EQ(s["status"], "completed");
  EXPECT_EQ(s["steps_completed"], 10);
  EXPECT_EQ(s["blocks"], 7);
  EXPECT_EQ(s["dofs"], 7 * 8 - 8);
  EXPECT_DOUBLE_EQ(s["time"].get<double>(), 0.1);
  EXPECT_GE(s["linear_solves"].get<int>(), 10);
  EXPECT_GT(s["peak_memory_mb"].get<double>(), 0);
  for (const char* key : {"total", "setup", "steps", "detection", "assembly", "solver", "analysis",
                          "factorization", "solution", "update", "output"})
    EXPECT_TRUE(s["wall_seconds"].contains(key)) << key;
  const nlohmann::json& seconds = s["wall_seconds"];
  const auto number = [&](const char* key) { return seconds[key].get<double>(); };
  EXPECT_LE(number("analysis") + number("factorization") + number("solution"), number("solver"));
  EXPECT_GE(s["analyses"].get<int>(), 1);
  EXPECT_TRUE(s["versions"].contains("blas"));
}

TEST_F(Program, TwoThreadsWriteTheSameBytes) {
  ASSERT_EQ(dda("make voronoi --cells 150 -o blocks.toml"), 0) << err_;
  for (const char* threads : {"1", "2"})
    ASSERT_EQ(dda("run blocks.toml --steps 2 --quiet --threads " + std::string(threads) + " -o " + threads),
              0)
        << err_;
  int n_files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(directory_ / "1")) {
    if (!entry.is_regular_file() || entry.path().filename() == "summary.json") continue;
    ++n_files;
    const fs::path name = fs::relative(entry.path(), directory_ / "1");
    EXPECT_TRUE(read_file(entry.path()) == read_file(directory_ / "2" / name)) << name;
  }
  EXPECT_GE(n_files, 10);
}

TEST_F(Program, DefaultDirectoryIsTheScenesNameWithOut) {
  write("my.scene.toml", read_file(POLYDDA_EXAMPLES "/paper/sliding_0.toml"));
  ASSERT_EQ(dda("run my.scene.toml --steps 1 --quiet"), 0) << err_;
  EXPECT_TRUE(fs::exists(directory_ / "my.scene-out/summary.json"));
}

TEST_F(Program, TheSceneAsRunGivesTheSameBytesAgain) {
  ASSERT_EQ(dda("run " + sliding +
                " -o first --quiet --set analysis.block_model=affine --set joint.0.friction_angle=20"),
            0);
  ASSERT_EQ(dda("run first/scene.toml -o second --quiet"), 0) << err_;
  for (const char* name : {"monitors.csv", "energy.csv", "blocks.csv", "vertices.csv", "contacts.csv",
                           "supports.csv", "scene.toml", "results.pvd", "contacts.pvd",
                           "frames/blocks_000035.vtu", "frames/contacts_000035.vtu"})
    EXPECT_EQ(read_file(directory_ / "first" / name), read_file(directory_ / "second" / name)) << name;
}

TEST_F(Program, OutputSaysWhichFramesThereAre) {
  const auto frames = [&](const std::string& setting) {
    EXPECT_EQ(dda("run " + sliding + " -o result --quiet --steps 10 --set 'output." + setting + "'"), 0)
        << err_;
    return number_of_frames("result");
  };
  EXPECT_EQ(frames("every=4"), 4);  // 0, 4, 8 and the end
  EXPECT_EQ(frames("every=0"), 1);
  frames("fields=[\"velocity\",\"principal\"]");
  const std::string with_fields = read_file(directory_ / "result/frames/blocks_000000.vtu");
  for (const char* name : {"velocity", "s1", "s2"})
    EXPECT_NE(with_fields.find("Name=\"" + std::string(name) + "\""), std::string::npos) << name;
  for (const char* name : {"displacement", "sxx"})
    EXPECT_EQ(with_fields.find("Name=\"" + std::string(name) + "\""), std::string::npos) << name;
}

TEST_F(Program, CheckComputesNothingAndEndsWithTheWorstStatus) {
  write("bad.toml", "format = 1\n");
  EXPECT_EQ(dda("check " + arch + " " + sliding), 0) << err_;
  EXPECT_EQ(dda("check " + arch + " bad.toml"), 2);
  EXPECT_NE(err_.find("bad.toml:"), std::string::npos);
  EXPECT_EQ(dda("check missing.toml bad.toml"), 4);
  EXPECT_FALSE(fs::exists(directory_ / "bad-out"));
}

TEST_F(Program, BlocksFromAGeometryFileAreInTheSceneAsRun) {
  fs::create_directories(directory_ / "wall");
  write(
      "wall/scene.toml",
      "blocks = \"blocks.geojson\"\n[analysis]\nsteps = 3\ntime_step = 0.01\n[[material]]\nname = \"rock\"\n"
      "density = 2500\nyoung = 1e9\npoisson = 0.25\n[[monitor]]\nname = \"m\"\nblock = \"top\"\nat = "
      "\"centroid\"\n");
  write("wall/blocks.geojson", R"({"type": "FeatureCollection", "features": [
    {"type": "Feature", "properties": {"fixed": true},
     "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [2, 0], [2, 1], [0, 1], [0, 0]]]}},
    {"type": "Feature", "properties": {"name": "top"},
     "geometry": {"type": "Polygon", "coordinates": [[[0, 1], [1, 1], [1, 2], [0, 2], [0, 1]]]}}]})");
  ASSERT_EQ(dda("check wall/scene.toml"), 0) << err_;
  ASSERT_EQ(dda("run wall/scene.toml -o first --quiet"), 0) << err_;
  EXPECT_EQ(summary("first")["blocks"], 2);
  ASSERT_EQ(dda("run first/scene.toml -o second --quiet"), 0) << err_;
  for (const char* name : {"monitors.csv", "vertices.csv", "contacts.csv", "scene.toml"})
    EXPECT_EQ(read_file(directory_ / "first" / name), read_file(directory_ / "second" / name)) << name;

  EXPECT_EQ(dda("check wall/scene.toml --set blocks=missing.wkt"), 4);
  EXPECT_NE(err_.find("wall/missing.wkt"), std::string::npos) << err_;
  write("wall/bad.wkt", "\nPOINT (0 0)\n");
  EXPECT_EQ(dda("run wall/scene.toml --set blocks=bad.wkt"), 2);
  EXPECT_NE(err_.find("wall/bad.wkt:2:1: error: "), std::string::npos) << err_;
  EXPECT_FALSE(fs::exists(directory_ / "wall/scene-out"));
}

TEST_F(Program, WrongInputWritesNothing) {
  write("bad.toml", "format = 1\n[analysis]\nstps = 3\n");
  EXPECT_EQ(dda("run bad.toml"), 2);
  EXPECT_NE(err_.find("bad.toml:3:1: error: "), std::string::npos) << err_;
  EXPECT_NE(err_.find("steps"), std::string::npos) << err_;
  EXPECT_FALSE(fs::exists(directory_ / "bad-out"));
  EXPECT_EQ(dda("run " + sliding + " -o result --set analysis.stps=3"), 2);
  EXPECT_FALSE(fs::exists(directory_ / "result"));
}

TEST_F(Program, WrongCallsEndWithStatus2) {
  for (const char* call : {"", "fly", "run", "run --nonsense", "check", "run a.toml --steps 0",
                           "run a.toml --steps many", "view DIR"}) {
    EXPECT_EQ(dda(call), 2) << call;
    EXPECT_EQ(err_.rfind("dda: error: ", 0), 0u) << call << ": " << err_;
  }
  for (const char* call : {"make", "make bricks -o a.wkt", "make voronoi", "make voronoi -o a.txt"}) {
    EXPECT_EQ(dda(call), 2) << call;
    EXPECT_EQ(err_.rfind("dda: error: ", 0), 0u) << call << ": " << err_;
  }
  EXPECT_EQ(dda("--help"), 0);
  EXPECT_EQ(dda("run --help"), 0);
  EXPECT_EQ(dda("--version"), 0);
}

TEST_F(Program, FilesThatCannotBeReadOrWrittenEndWithStatus4) {
  EXPECT_EQ(dda("run missing.toml"), 4);
  EXPECT_NE(err_.find("missing.toml"), std::string::npos);
  write("file", "");
  EXPECT_EQ(dda("run " + sliding + " -o file/result --steps 1"), 4) << err_;
}

TEST_F(Program, AnAnalysisThatMustStopKeepsWhatItComputed) {
  // A blow so hard that no substep is short enough for the limit on motion.
  ASSERT_EQ(dda("run " + sliding + " -o result --quiet --set block.slider.velocity=[1e9,0.0]"), 3);
  EXPECT_NE(err_.find("slider"), std::string::npos) << err_;
  const nlohmann::json s = summary("result");
  EXPECT_EQ(s["status"], "stopped");
  EXPECT_FALSE(s["reason"].get<std::string>().empty());
  EXPECT_TRUE(fs::exists(directory_ / "result/vertices.csv"));
  EXPECT_EQ(number_of_frames("result"), 1);
}

/// A scene of a block between a floor and a press, with more tables at its end.
std::string press(const std::string& core, const std::string& tables) {
  return "format = 1\n[analysis]\nsteps = 60\ntime_step = 0.01\n"
         "[[material]]\nname = \"rock\"\ndensity = 2500\nyoung = \"1 GPa\"\npoisson = 0.25\n"
         "[[joint]]\nfriction_angle = 30\n"
         "[[block]]\nname = \"floor\"\nmaterial = \"rock\"\nfixed = true\n"
         "vertices = [[-2, -1], [2, -1], [2, 0], [-2, 0]]\n"
         "[[block]]\nname = \"core\"\nmaterial = \"rock\"\nvertices = " +
         core +
         "\n[[block]]\nname = \"press\"\nmaterial = \"rock\"\n"
         "vertices = [[-2, 1], [2, 1], [2, 2], [-2, 2]]\n" +
         tables;
}

const std::string wedge = "[[-0.5, 0], [0.5, 0], [0, 1]]";

TEST_F(Program, AStepThatHasNoSolutionStopsTheRunAndNamesTheContact) {
  // The press reaches the floor after 0.5 s: nothing is left of the wedge between them then.
  write("press.toml",
        press(wedge, "[[support]]\nblock = \"press\"\nvertices = [0, 1, 2, 3]\nvelocity = [0, -2]\n"));
  ASSERT_EQ(dda("run press.toml -o result --quiet"), 3) << err_;
  const nlohmann::json s = summary("result");
  EXPECT_EQ(s["status"], "stopped");
  const std::string reason = s["reason"].get<std::string>();
  for (const char* words : {"penetration", "between blocks", "\"core\"", "time_step"}) {
    EXPECT_NE(reason.find(words), std::string::npos) << reason;
    EXPECT_NE(err_.find(words), std::string::npos) << err_;
  }
  EXPECT_EQ(s["steps_completed"], 50);
  EXPECT_GT(s["rejected_steps"], 0);
  EXPECT_EQ(s["unconverged_steps"], 0);
  EXPECT_LE(s["max_residual"].get<double>(), 1e-8);
  EXPECT_GE(number_of_frames("result"), 51);
  EXPECT_EQ(read_csv(directory_ / "result/energy.csv").size(), 1u + 51u);
  EXPECT_EQ(read_csv(directory_ / "result/blocks.csv").size(), 1u + 3u);
  EXPECT_GT(read_csv(directory_ / "result/contacts.csv").size(), 1u);
  EXPECT_TRUE(fs::exists(directory_ / "result/log.txt"));
}

TEST_F(Program, CheckSaysWhereABadSceneIsBad) {
  const auto refused = [&](const std::string& scene, const std::string& setting, const std::string& place,
                           const char* words) {
    write("bad.toml", scene);
    EXPECT_EQ(dda("check bad.toml" + setting), 2);
    EXPECT_NE(err_.find("bad.toml:" + place + ": error: "), std::string::npos) << err_;
    EXPECT_NE(err_.find(words), std::string::npos) << err_;
  };
  refused(press("[[-0.5, 0], [0.5, 0], [0, 1.2]]", ""), "", "24:12", "overlaps block 'core' by 0.2 m");
  refused(press("[[5, 0], [6, 0], [5.5, 1]]", ""), " --set analysis.mode=static", "20:12",
          "'core' is free and nothing can hold it");
  refused(press(wedge, "[contact]\nnormal_stiffness = -1e9\n"), "", "26:20", "'normal_stiffness' = '-1e+09'");
}

TEST_F(Program, MakeVoronoiWritesASceneThatRuns) {
  ASSERT_EQ(dda("make voronoi -o rock.toml"), 0) << err_;
  EXPECT_EQ(out_, "rock.toml: 100 Voronoi blocks, seed 1\n");
  EXPECT_TRUE(err_.empty()) << err_;
  ASSERT_EQ(dda("check rock.toml"), 0) << err_;
  EXPECT_TRUE(err_.empty()) << err_;
  ASSERT_EQ(dda("make voronoi -o rock.toml --cells 20 --seed 2 --lloyd 5 --smallest-edge 0.2"), 0) << err_;
  ASSERT_EQ(dda("run rock.toml -o result --quiet"), 0) << err_;
  const nlohmann::json s = summary("result");
  EXPECT_EQ(s["status"], "completed");
  EXPECT_EQ(s["blocks"], 20);
}

TEST_F(Program, MakeKeepsASceneThatWasEdited) {
  ASSERT_EQ(dda("make column -o c.toml"), 0) << err_;
  ASSERT_EQ(dda("make column -o c.toml"), 0) << err_;
  EXPECT_EQ(out_.find("older"), std::string::npos) << out_;
  write("c.toml", "mine");
  ASSERT_EQ(dda("make column -o c.toml"), 0) << err_;
  EXPECT_NE(out_.find("the older c.toml is c.1.toml now"), std::string::npos) << out_;
  EXPECT_EQ(read_file(directory_ / "c.1.toml"), "mine");
  EXPECT_EQ(dda("check c.toml"), 0) << err_;
}

TEST_F(Program, MakeVoronoiGivesTheSameBytesForTheSameSeed) {
  for (const char* ending : {"wkt", "geojson", "toml"}) {
    const std::string file(ending);
    ASSERT_EQ(dda("make voronoi --domain '0,0 3,0 3,1 1,1 1,2 0,2' --seed 5 -o a." + file), 0) << err_;
    ASSERT_EQ(dda("make voronoi --domain '0,0 3,0 3,1 1,1 1,2 0,2' --seed 5 -o b." + file), 0) << err_;
    ASSERT_EQ(dda("make voronoi --domain '0,0 3,0 3,1 1,1 1,2 0,2' --seed 6 -o c." + file), 0) << err_;
    EXPECT_EQ(read_file(directory_ / ("a." + file)), read_file(directory_ / ("b." + file)));
    EXPECT_NE(read_file(directory_ / ("a." + file)), read_file(directory_ / ("c." + file)));
  }
}

TEST_F(Program, MakeVoronoiRefusesWhatMakesNoSense) {
  for (const char* options :
       {"--cells 0", "--cells many", "--seed -1", "--lloyd -1", "--smallest-edge 2", "--box 1", "--box 0 1",
        "--box 1 nan", "--domain '0,0 1,0'", "--domain '0,0 1,0 1'", "--domain '0,0 1,0 1,1x'",
        "--domain '0,0 2,2 2,0 0,2'", "--box 1 1 --domain '0,0 1,0 1,1'", "--corners 4"}) {
    EXPECT_EQ(dda(std::string("make voronoi -o a.wkt ") + options), 2) << options;
    EXPECT_EQ(err_.rfind("dda: error: ", 0), 0u) << options << ": " << err_;
    EXPECT_EQ(std::count(err_.begin(), err_.end(), '\n'), 1) << err_;
    EXPECT_FALSE(fs::exists(directory_ / "a.wkt")) << options;
  }
  EXPECT_EQ(dda("make voronoi -o missing/a.wkt"), 4);
  EXPECT_NE(err_.find("missing/a.wkt"), std::string::npos);
}

TEST_F(Program, MakesScenesThatItUnderstands) {
  for (const std::string kind :
       {"joints --height 10", "tunnel", "wall --door-width 0", "arch --fill", "column", "heap --blocks 5"}) {
    ASSERT_EQ(dda("make " + kind + " -o a.toml"), 0) << err_;
    EXPECT_EQ(dda("check a.toml"), 0) << kind << err_;
    ASSERT_EQ(dda("make " + kind + " -o a.dxf"), 0) << err_;
    EXPECT_EQ(dda("cut a.dxf -o a.wkt"), 0) << kind << err_;
  }
  EXPECT_EQ(dda("make wall --length -1 -o a.toml"), 2);
  EXPECT_EQ(dda("make column -o missing/a.toml"), 4);
}

TEST_F(Program, CutSplitsConcaveBlocksAndSaysSo) {
  write("shapes.toml", press("[[-0.5, 0], [0.5, 0], [0.25, 0.5], [0.5, 1], [-0.5, 1], [-0.5, 0.5]]", "") +
                           "[[monitor]]\nname = \"m\"\nblock = \"core\"\nat = \"centroid\"\n");
  ASSERT_EQ(dda("cut shapes.toml -o convex.toml --convex"), 0) << err_;
  EXPECT_EQ(out_, "convex.toml: 4 blocks\n");
  EXPECT_NE(
      err_.find("shapes.toml: 3 blocks to 4: 1 split, 0 short edges taken out, 0 straight vertices dropped"),
      std::string::npos)
      << err_;
  EXPECT_NE(err_.find("monitors"), std::string::npos) << err_;
  EXPECT_EQ(dda("check convex.toml --set analysis.block_model=wachspress"), 0) << err_;
  const std::string text = read_file(directory_ / "convex.toml");
  for (const char* name : {"\"floor\"", "\"core.1\"", "\"core.2\"", "\"press\"", "friction_angle = 30.0"})
    EXPECT_NE(text.find(name), std::string::npos) << name;

  ASSERT_EQ(dda("cut shapes.toml -o simple.geojson --drop-straight --shortest-edge 0.01"), 0) << err_;
  EXPECT_NE(err_.find("3 blocks to 3: 0 split, 0 short edges taken out, 1 straight vertex dropped"),
            std::string::npos)
      << err_;
  ASSERT_EQ(dda("cut simple.geojson -o simple.wkt --convex"), 0) << err_;
  const std::string wkt = read_file(directory_ / "simple.wkt");
  EXPECT_EQ(std::count(wkt.begin(), wkt.end(), '\n'), 4) << wkt;
}

TEST_F(Program, CutKeepsTheJointsOfEdgesOfADomain) {
  ASSERT_EQ(dda("make joints -o a.toml"), 0) << err_;
  ASSERT_EQ(dda("cut a.toml -o b.toml"), 0) << err_;
  ASSERT_EQ(dda("cut b.toml -o c.toml --convex --shortest-edge 0.05 --drop-straight"), 0) << err_;
  EXPECT_EQ(dda("check c.toml"), 0) << err_;
  EXPECT_NE(read_file(directory_ / "c.toml").find("edge_joints"), std::string::npos);
}

TEST_F(Program, CutRefusesWhatMakesNoSense) {
  write("a.wkt", "POLYGON ((0 0, 1 0, 1 1, 0 0))\n");
  write("bad.wkt", "\nPOLYGON ((0 0, 2 2, 2 0, 0 2, 0 0))\n");
  for (const char* call :
       {"cut", "cut a.wkt --convex", "cut a.wkt -o b.wkt --snap 0", "cut a.wkt -o b.shp --convex",
        "cut a.wkt -o b.wkt --shortest-edge 2", "cut a.wkt -o b.wkt --shortest-edge x"}) {
    EXPECT_EQ(dda(call), 2) << call;
    EXPECT_EQ(err_.rfind("dda: error: ", 0), 0u) << call << ": " << err_;
  }
  EXPECT_EQ(dda("cut bad.wkt -o b.wkt --convex"), 2);
  EXPECT_NE(err_.find("bad.wkt:2:"), std::string::npos) << err_;
  EXPECT_EQ(dda("cut missing.wkt -o b.wkt --convex"), 4);
  EXPECT_EQ(dda("cut a.wkt -o missing/b.wkt --convex"), 4);
  EXPECT_FALSE(fs::exists(directory_ / "b.wkt"));
  EXPECT_EQ(dda("cut --help"), 0);
}

TEST_F(Program, ASignalEndsTheRunWithItsResults) {
  const std::string command = "timeout -s TERM 1 " POLYDDA_PROGRAM " run " + sliding + " -o '" +
                              (directory_ / "result").string() + "' --steps 100000000 --quiet 2> /dev/null";
  const int status = std::system(("sh -c \"" + command + "; exit \\$?\"").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 124);  // timeout's own; the program ended by itself
  EXPECT_EQ(summary("result")["status"], "interrupted");
}

}  // namespace
