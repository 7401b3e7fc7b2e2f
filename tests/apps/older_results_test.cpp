/// \file Running a scene again loses no results.
#include "program.hpp"

namespace {

using support::Program;
using support::read_file;

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

TEST_F(OlderResults, StayWhereTheSceneIsWrong) {
  ASSERT_EQ(run("--quiet --steps 2"), 0);
  ASSERT_EQ(run("--set analysis.stps=3"), 2);
  EXPECT_EQ(steps_of("result"), 2);
}

TEST_F(OlderResults, OtherFilesAreNoResults) {
  std::filesystem::create_directory(directory_ / "result");
  write("result/notes.txt", "mine");
  ASSERT_EQ(run("--quiet --steps 2"), 0);
  EXPECT_EQ(read_file(directory_ / "result/notes.txt"), "mine");
}

}  // namespace
