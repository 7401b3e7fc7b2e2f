#include <ddacontact/scene/spelling.hpp>

#include <gtest/gtest.h>

namespace {

using namespace ddacontact::scene_format;

TEST(Spelling, DistanceCountsEdits) {
  EXPECT_EQ(edit_distance("", ""), 0);
  EXPECT_EQ(edit_distance("young", ""), 5);
  EXPECT_EQ(edit_distance("young", "young"), 0);
  EXPECT_EQ(edit_distance("yuong", "young"), 1);
  EXPECT_EQ(edit_distance("yung", "young"), 1);
  EXPECT_EQ(edit_distance("yooung", "young"), 1);
  EXPECT_EQ(edit_distance("Young", "young"), 0);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance(std::string(1000, 'a'), "a"), 63);
}

TEST(Spelling, DistanceIsSymmetric) {
  for (const char* a : {"abc", "acb", "friction", "fraction_angle", ""})
    for (const char* b : {"cab", "friction_angle", "x"}) EXPECT_EQ(edit_distance(a, b), edit_distance(b, a));
}

TEST(Spelling, NearWordsAreSuggestedAndOthersListed) {
  EXPECT_EQ(suggestion("yuong", "key", {"name", "young"}), "did you mean 'young'?");
  EXPECT_EQ(suggestion("friction", "key", {"cohesion", "friction_angle"}), "did you mean 'friction_angle'?");
  EXPECT_EQ(suggestion("max_steps", "key", {"mode", "steps"}), "did you mean 'steps'?");
  EXPECT_EQ(suggestion("velocity", "key", {"name", "young"}),
            "the nearest known key is 'young'; known: name, young");
  EXPECT_EQ(suggestion("x", "block", {}), "there is no block");
}

TEST(Spelling, ExcerptsEndAtACharacter) {
  EXPECT_EQ(excerpt("short"), "short");
  EXPECT_EQ(excerpt(std::string(39, 'a') + "\u00e9\u00e9"), std::string(39, 'a') + "...");
  EXPECT_EQ(excerpt(std::string(60, 'a')), std::string(40, 'a') + "...");
}

}  // namespace
