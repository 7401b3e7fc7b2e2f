/// \file Running a scene again loses no results.
#include "program.hpp"

#include <ddacontact/output/older_results.hpp>
#include <ddacontact/output/output_error.hpp>
#include <ddacontact/output/whole_file.hpp>

namespace {

using support::Program;
using support::read_file;
namespace fs = std::filesystem;

class OlderResults : public Program {
 protected:
  int run(const std::string& arguments) {
    return dda("run '" POLYDDA_EXAMPLES "/paper/sliding_0.toml' -o result " + arguments);
  }
  int steps_of(const std::string& directory) const { return summary(directory)["steps_completed"]; }
};

TEST_F(OlderResults, AreRenamedWithTheNextNumber) {
  ASSERT_EQ(run("--quiet --steps 2"), 0);
  ASSERT_EQ(run("--quiet --steps 3"), 0);
  ASSERT_EQ(run("--steps 4"), 0);
  EXPECT_NE(err_.find("older results are in result.2"), std::string::npos) << err_;
  EXPECT_EQ(steps_of("result"), 4);
  EXPECT_EQ(steps_of("result.1"), 2);
  EXPECT_EQ(steps_of("result.2"), 3);
}

TEST_F(OlderResults, AreOverwrittenByForce) {
  ASSERT_EQ(run("--quiet --steps 2"), 0);
  ASSERT_EQ(run("--quiet --steps 3 --force"), 0);
  EXPECT_EQ(steps_of("result"), 3);
  EXPECT_FALSE(std::filesystem::exists(directory_ / "result.1"));
}

TEST_F(OlderResults, AreGoneOnWithByResume) {
  ASSERT_EQ(run("--quiet --steps 2"), 0);
  ASSERT_EQ(run("--quiet --steps 4 --resume result/checkpoint.bin"), 0) << err_;
  EXPECT_EQ(steps_of("result"), 4);
  EXPECT_FALSE(std::filesystem::exists(directory_ / "result.1"));
}

TEST_F(OlderResults, OfAnotherRunAreKeptByResume) {
  ASSERT_EQ(run("--quiet --steps 2"), 0);
  std::filesystem::rename(directory_ / "result", directory_ / "first");
  ASSERT_EQ(run("--quiet --steps 3"), 0);
  ASSERT_EQ(run("--quiet --steps 5 --resume first/checkpoint.bin"), 0) << err_;
  EXPECT_EQ(steps_of("result"), 5);
  EXPECT_EQ(steps_of("result.1"), 3);
}

TEST_F(OlderResults, AreKeptByANewStage) {
  const std::string go_on = "--quiet --as-stage --resume result/checkpoint.bin";
  ASSERT_EQ(run("--quiet --steps 2"), 0);
  ASSERT_EQ(run(go_on), 0) << err_;
  EXPECT_EQ(steps_of("result.1"), 2);
  EXPECT_EQ(steps_of("result"), 37);
  EXPECT_EQ(support::read_csv(directory_ / "result/energy.csv").size(), 1u + 38u)
      << "with those of the first";
  ASSERT_EQ(run(go_on), 0) << "a second stage after the first one: " << err_;
  EXPECT_EQ(steps_of("result"), 72);
  EXPECT_EQ(steps_of("result.2"), 37);
}

TEST_F(OlderResults, AreLeftToTheRunThatStillWritesThem) {
  ASSERT_EQ(run("--quiet --steps 2"), 0);
  const ddacontact::DirectoryLock of_another_run(directory_ / "result");
  for (const char* call :
       {"--quiet --steps 3", "--quiet --steps 3 --force", "--quiet --resume result/checkpoint.bin"}) {
    EXPECT_EQ(run(call), 4) << call;
    EXPECT_NE(err_.find("is being written by another run"), std::string::npos) << err_;
  }
  EXPECT_EQ(steps_of("result"), 2);
}

TEST_F(OlderResults, AreNotRenamedWithTheSceneOrAFileThatItNames) {
  const auto refuses = [&](const std::string& call, const std::string& file) {
    EXPECT_EQ(dda(call), 2) << call;
    EXPECT_NE(err_.find("holds \"" + file + "\""), std::string::npos) << err_;
    EXPECT_NE(err_.find("name another directory for --output"), std::string::npos) << err_;
    EXPECT_TRUE(fs::exists(directory_ / file)) << call;
  };
  ASSERT_EQ(run("--quiet --steps 2"), 0);
  for (const char* verb : {"run", "safety"})
    refuses(verb + std::string(" result/scene.toml -o result/"), "result/scene.toml");
  EXPECT_EQ(dda("run result/scene.toml -o result --resume result/checkpoint.bin --quiet"), 0)
      << "nothing is renamed: " << err_;
  fs::create_directory(directory_ / "blocks");
  write("blocks/wall.wkt", "POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0))\n");
  write("wall.toml",
        "blocks = \"blocks/wall.wkt\"\n[analysis]\nsteps = 1\ntime_step = 0.01\n"
        "[[material]]\nname = \"rock\"\ndensity = 2500\nyoung = 1e9\npoisson = 0.2\n");
  EXPECT_EQ(dda("run wall.toml -o blocks --quiet"), 0) << "there are no results yet: " << err_;
  refuses("run wall.toml -o blocks", "blocks/wall.wkt");
  fs::create_directory(directory_ / "swept");
  fs::rename(directory_ / "result", directory_ / "swept/case-1");
  refuses("sweep swept/case-1/scene.toml -o swept --vary analysis.steps=1,2", "swept/case-1/scene.toml");
}

TEST_F(OlderResults, AreNotWrittenOverTheScene) {
  const std::string scene = read_file(fs::path(POLYDDA_EXAMPLES "/paper/sliding_0.toml"));
  fs::create_directory(directory_ / "own");
  write("own/scene.toml", scene);
  for (const char* force : {"", " --force"}) {
    EXPECT_EQ(dda(std::string("run own/scene.toml -o own --quiet") + force), 2);
    EXPECT_NE(err_.find("would be written over \"own/scene.toml\""), std::string::npos) << err_;
    EXPECT_EQ(read_file(directory_ / "own/scene.toml"), scene);
  }
  fs::rename(directory_ / "own/scene.toml", directory_ / "own/slide.toml");
  EXPECT_EQ(dda("run own/slide.toml -o own --quiet --steps 1"), 0) << "another name is no result's: " << err_;
}

TEST_F(OlderResults, OfSearchesAndSweepsAreKeptToo) {
  const std::string scene = " '" POLYDDA_EXAMPLES "/paper/sliding_30.toml' --quiet -o result ";
  ASSERT_EQ(dda("safety" + scene + "--set analysis.preset=default --range 0.3:0.9 --tolerance 0.5"), 0)
      << err_;
  ASSERT_EQ(dda("safety" + scene + "--set analysis.preset=default --range 0.4:0.8 --tolerance 0.5"), 0)
      << err_;
  EXPECT_TRUE(std::filesystem::exists(directory_ / "result.1/safety.json"));
  ASSERT_EQ(dda("sweep" + scene + "--vary analysis.steps=2,3"), 0) << err_;
  ASSERT_EQ(dda("sweep" + scene + "--vary analysis.steps=2,3"), 0) << err_;
  EXPECT_FALSE(std::filesystem::exists(directory_ / "result/sweep.1.csv")) << "nothing is new";
  ASSERT_EQ(dda("sweep" + scene + "--vary analysis.steps=5"), 0) << err_;
  EXPECT_EQ(support::read_csv(directory_ / "result/sweep.1.csv").size(), 3u);
  EXPECT_EQ(steps_of("result/case-1.1"), 2);
  EXPECT_EQ(steps_of("result/case-1"), 5);
}

TEST_F(OlderResults, StayWhereTheSceneIsWrong) {
  ASSERT_EQ(run("--quiet --steps 2"), 0);
  ASSERT_EQ(run("--set analysis.stps=3"), 2);
  EXPECT_EQ(steps_of("result"), 2);
}

TEST_F(OlderResults, OfCutAreKeptUnderANumber) {
  for (const std::string file : {"a.toml", "a.wkt"}) {
    ASSERT_EQ(dda("make voronoi --cells 5 -o " + file), 0) << err_;
    const std::string older = read_file(directory_ / file);
    ASSERT_EQ(dda("cut " + file + " -o " + file + " --shortest-edge 0.5"), 0) << err_;
    const std::string kept = "a.1" + file.substr(1);
    EXPECT_NE(out_.find("the older " + file + " is " + kept + " now"), std::string::npos) << out_;
    EXPECT_EQ(read_file(directory_ / kept), older);
    EXPECT_NE(read_file(directory_ / file), older);
  }
}

TEST_F(OlderResults, StayWhereAFileCannotBeWritten) {
  write("a.svg", "older");
  const auto half = [](std::ostream& out) { (out << "half").setstate(std::ios::badbit); };
  EXPECT_THROW(ddacontact::write_whole(directory_ / "a.svg", half), ddacontact::OutputError);
  EXPECT_EQ(read_file(directory_ / "a.svg"), "older");
  EXPECT_EQ(std::distance(fs::directory_iterator(directory_), {}), 1) << "the half is gone";
  fs::create_symlink("a.svg", directory_ / "b.svg");
  ddacontact::write_whole(directory_ / "b.svg", [](std::ostream& out) { out << "newer"; });
  EXPECT_EQ(read_file(directory_ / "a.svg"), "newer");
  EXPECT_TRUE(fs::is_symlink(directory_ / "b.svg"));
}

TEST_F(OlderResults, OfAFullDiskAreToldWithTheReason) {
  ASSERT_EQ(run("--quiet --steps 2"), 0);
  const std::string scene = " '" POLYDDA_EXAMPLES "/paper/sliding_30.toml' ";
  for (const std::string& call : std::vector<std::string>{
           "make column -o x.toml", "make voronoi -o x.wkt", "cut" + scene + "-o x.wkt",
           "plot result -o x.svg", "plot result -o x.png", "plot result -o x.pdf", "view result -o x.html"}) {
    const fs::path name = directory_ / call.substr(call.rfind(' ') + 1);
    fs::remove(name);
    fs::create_symlink("/dev/full", name);
    const int status = dda(call);
    if (status == 2) continue;  // built without librsvg
    EXPECT_EQ(status, 4) << call;
    EXPECT_NE(err_.find("cannot write"), std::string::npos) << err_;
    EXPECT_NE(err_.find("No space left on device"), std::string::npos) << err_;
  }
  for (const std::string file : {"scene.toml", "monitors.csv"}) {
    fs::create_directory(directory_ / file);
    fs::create_symlink("/dev/full", directory_ / file / file);
    EXPECT_EQ(dda("run" + scene + "--steps 2 --quiet --force -o " + file), 4) << file;
    EXPECT_NE(err_.find("No space left on device"), std::string::npos) << file << ": " << err_;
  }
  for (const std::string answer : {"schema", "--version", "--help"}) {
    EXPECT_EQ(dda(answer + " > /dev/full 2> problem; exit $?; true"), 4) << answer;
    EXPECT_NE(read_file(directory_ / "problem").find("No space left on device"), std::string::npos) << answer;
  }
}

TEST_F(OlderResults, OfOthersAreNotOverwritten) {
  fs::create_directory(directory_ / "mine");
  write("mine/blocks.csv", "of a survey");
  const std::string call = "run '" POLYDDA_EXAMPLES "/paper/sliding_0.toml' --steps 2 --quiet -o mine";
  EXPECT_EQ(dda(call), 4);
  EXPECT_NE(err_.find("blocks.csv\" is of no run"), std::string::npos) << err_;
  EXPECT_EQ(read_file(directory_ / "mine/blocks.csv"), "of a survey");
  EXPECT_EQ(dda(call + " --force"), 0) << err_;
}

TEST_F(OlderResults, AreNotLostWithWhatCannotBeTold) {
  for (const std::string lost : {"/dev/full", "&-"}) {
    const std::string call = "run '" POLYDDA_EXAMPLES "/paper/sliding_0.toml' --steps 2 --force -o told 2>";
    EXPECT_EQ(dda(call + lost + "; exit $?; true"), 0) << lost;
    EXPECT_EQ(steps_of("told"), 2);
    for (const char* file : {"told/monitors.csv", "told/energy.csv"})
      EXPECT_EQ(read_file(directory_ / file).find("step "), std::string::npos) << file;
    EXPECT_EQ(dda("run none.toml 2>" + lost + "; exit $?; true"), 4) << lost;
  }
}

TEST_F(OlderResults, OfALimitOnTheSizeOfFilesAreToldLikeAFullDisk) {
  const std::string call = "run '" POLYDDA_EXAMPLES "/paper/sliding_0.toml' --steps 2 --quiet -o limited";
  const int status = std::system(
      ("cd '" + directory_.string() + "' && ulimit -f 1 && " + POLYDDA_PROGRAM " " + call + " 2> problem")
          .c_str());
  ASSERT_TRUE(WIFEXITED(status)) << WTERMSIG(status);
  EXPECT_EQ(WEXITSTATUS(status), 4);
  EXPECT_NE(read_file(directory_ / "problem").find("File too large"), std::string::npos);
  for (const auto& entry : fs::recursive_directory_iterator(directory_ / "limited"))
    EXPECT_FALSE(entry.path().extension().string().starts_with(".part")) << entry.path();
}

TEST_F(OlderResults, OtherFilesAreNoResults) {
  std::filesystem::create_directory(directory_ / "result");
  write("result/notes.txt", "mine");
  ASSERT_EQ(run("--quiet --steps 2"), 0);
  EXPECT_EQ(read_file(directory_ / "result/notes.txt"), "mine");
}

}  // namespace
