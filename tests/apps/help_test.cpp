/// \file `dda help`, `dda schema` and `dda --help`.
#include "program.hpp"

#include <ddacontact/scene/catalog.hpp>
#include <ddacontact/scene/words.hpp>

namespace {

using support::Program;
using support::read_file;
using namespace ddacontact;

class Help : public Program {
 protected:
  bool says(const std::string& text) const { return out_.find(text) != std::string::npos; }
};

TEST_F(Help, NamesExamplesAndExitStatuses) {
  ASSERT_EQ(dda("--help"), 0);
  for (const char* words : {"dda make joints -o rock.toml", "Exit status: 0 done", "dda help"})
    EXPECT_TRUE(says(words)) << out_;
  ASSERT_EQ(dda("run --help"), 0);
  EXPECT_FALSE(says("Examples:")) << out_;
}

TEST_F(Help, HasEveryTableOfTheSceneWithItsKeys) {
  for (const scene_format::CatalogEntry& entry : scene_format::catalog()) {
    if (entry.kind == scene_format::CatalogEntry::Kind::key) continue;
    ASSERT_EQ(dda("help " + std::string(entry.name)), 0) << err_;
    for (const std::string_view key : entry.keys) {
      const bool in_stages_alone = entry.name == "joint" && key == "glued";
      const bool of_the_whole_run = entry.name == "stage" && out_.find(key) == std::string::npos;
      if (in_stages_alone || of_the_whole_run) continue;
      EXPECT_TRUE(says("\n  " + std::string(key))) << entry.name << '.' << key;
    }
  }
  ASSERT_EQ(dda("help joint"), 0);
  EXPECT_TRUE(says("friction_angle: a number in deg, >= 0 and < 90; default 0.0")) << out_;
  ASSERT_EQ(dda("help domain"), 0);
  EXPECT_TRUE(says("domain.joint_set\n") && says("spacing: a number in m, > 0; required")) << out_;
}

TEST_F(Help, HasEveryTopicOfItsList) {
  ASSERT_EQ(dda("help"), 0);
  std::istringstream words(out_.substr(out_.find('\n')));
  int n_topics = 0;
  for (std::string topic; words >> topic; ++n_topics) EXPECT_EQ(dda("help " + topic), 0) << topic;
  EXPECT_GE(n_topics, 18);
}

TEST_F(Help, DescribesEveryScheme) {
  ASSERT_EQ(dda("help schemes"), 0);
  for (const auto& word : scene_format::words_of(Scheme{}))
    EXPECT_TRUE(says('"' + std::string(word.text) + '"'));
}

TEST_F(Help, OfAVerbIsThatOfItsOption) {
  for (const std::string verb : {"run", "make", "make wall", "sweep", "help"}) {
    ASSERT_EQ(dda("help " + verb), 0) << err_;
    const std::string text = out_;
    EXPECT_TRUE(says("Usage: dda " + verb + " ")) << out_;
    ASSERT_EQ(dda(verb + " --help"), 0);
    EXPECT_EQ(out_, text);
  }
}

TEST_F(Help, NamesWhatOptionsTakeInPlainWords) {
  for (const std::string verb : {"", "run", "check", "make", "cut", "plot", "view", "info", "safety", "sweep",
                                 "help", "make joints", "make wall", "make heap", "make voronoi"}) {
    ASSERT_EQ(dda(verb + " --help"), 0) << err_;
    for (const char* word : {"INT", "FLOAT", "TEXT", "REQUIRED", "SUBCOMMAND", "Needs", "Excludes", " in ["})
      EXPECT_FALSE(says(word)) << word << '\n' << out_;
  }
  ASSERT_EQ(dda("run --help"), 0);
  for (const char* words : {"--steps N ", "; 1 or more\n", "(required)", "(default 1)", "(with --resume)"})
    EXPECT_TRUE(says(words)) << words << '\n' << out_;
}

TEST_F(Help, NamesTheNearestTopic) {
  EXPECT_EQ(dda("help unit"), 2);
  EXPECT_NE(err_.find("did you mean \"units\"?"), std::string::npos) << err_;
}

TEST_F(Help, CompletesVerbsOptionsAndFiles) {
  ASSERT_EQ(dda("help completion"), 0);
  write("complete.sh", out_ + R"(
try() { COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); COMPREPLY=(); _dda; echo "${COMPREPLY[@]}"; }
try dda sa
try ./dda run --for
try dda make ''
try dda make wall --door
try dda help unit
try dda help saf
try dda plot 'my result' --field s
try dda plot result --vectors ''
try dda run comp
complete -p dda
)");
  const std::string shell = "cd '" + directory_.string() + "' && bash complete.sh > completed.txt 2>&1";
  ASSERT_EQ(std::system(shell.c_str()), 0);
  EXPECT_EQ(
      read_file(directory_ / "completed.txt"),
      "safety\n--force\njoints tunnel heap wall arch column voronoi -h --help\n--door-width --door-height\n"
      "units\nsafety\nsxx syy sxy s1 s2\ndisplacement velocity\n"
      // Files, with spaces or without, are completed by the shell itself.
      "\ncomplete -o default -F _dda dda\n");
}

TEST_F(Help, SchemaIsJsonWithEveryTable) {
  ASSERT_EQ(dda("schema"), 0);
  const nlohmann::json properties = nlohmann::json::parse(out_)["properties"];
  for (const scene_format::CatalogEntry& entry : scene_format::catalog())
    EXPECT_TRUE(properties.contains(entry.name)) << entry.name;
}

}  // namespace
