// Keys of other programs: one message that says what to write, or that this version has no such thing.
#include "example_scenes.hpp"

#include <ddacontact/scene/catalog.hpp>
#include <ddacontact/scene/guessed_keys.hpp>

#include <ostream>

namespace {

using namespace example_scenes;
using namespace ddacontact::scene_format;

struct Case {
  const char* name;
  const char* from;  ///< in the complete scene
  const char* to;
  int line, column;
  std::vector<const char*> words;  ///< all stand in the message
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

const char joint[] = "friction_angle = 30.0", steps[] = "steps = 35", young[] = "young = 35e6",
           contact[] = "[contact]\n", output[] = "[output]\n";

const Case cases[] = {
    {"NormalStiffnessOfJoint",
     joint,
     "friction_angle = 30.0\nkn = 1e9",
     24,
     1,
     {"unknown key 'kn' in [[joint]]", "rigid", "'normal_stiffness'"}},
    {"ShearStiffnessOfJoint",
     joint,
     "friction_angle = 30.0\nJKS = 1e9",
     24,
     1,
     {"unknown key 'JKS'", "rigid"}},
    {"Phi", joint, "phi = 30", 23, 1, {"'phi'", "'friction_angle' in degrees"}},
    {"Mu", joint, "mu = 0.6", 23, 1, {"'mu'", "atan(mu)"}},
    {"Dilation", joint, "friction_angle = 30.0\ndilation = 5", 24, 1, {"'dilation'", "'dilation_angle'"}},
    {"NormalStiffnessOfContact",
     contact,
     "[contact]\nkn = 1e9\n",
     10,
     1,
     {"'kn' in [contact]", "'normal_stiffness' in N/m2"}},
    {"ShearStiffnessOfContact",
     contact,
     "[contact]\nks = 1e9\n",
     10,
     1,
     {"'ks' in [contact]", "'tangential_stiffness' in N/m2"}},
    {"JointStiffness", contact, "[contact]\njoint_stiffness = 1e9\n", 10, 1, {"'joint_stiffness'", "rigid"}},
    {"CohesionOfContact",
     contact,
     "[contact]\ncohesion = 1e3\n",
     10,
     1,
     {"'cohesion' in [contact]", "[[joint]]"}},
    {"YoungsModulus", young, "young = 35e6\nE = 35e6", 15, 1, {"'E' in [[material]]", "'young' in Pa"}},
    {"PoissonsRatio", young, "young = 35e6\nnu = 0.3", 15, 1, {"'nu'", "'poisson'"}},
    {"CohesionOfMaterial",
     young,
     "young = 35e6\ncohesion = 1e3",
     15,
     1,
     {"'cohesion' in [[material]]", "strength is that of contacts"}},
    {"BulkModulus", young, "young = 35e6\nbulk = 1e9", 15, 1, {"'bulk'", "9KG/(3K + G)"}},
    {"TimeStep", steps, "steps = 35\ndt = 0.01", 6, 1, {"'dt' in [analysis]", "'time_step'"}},
    {"EndTime", steps, "steps = 35\nend_time = 2", 6, 1, {"'end_time'", "'steps'"}},
    {"Acceleration",
     steps,
     "steps = 35\nacceleration = [0, 1]",
     6,
     1,
     {"'acceleration'", "'gravity'", "[[quake]]"}},
    {"UntilOfAnalysis",
     steps,
     "steps = 35\nuntil = { kinetic = 1e-8 }",
     6,
     1,
     {"'until' in [analysis]", "[[stage]]"}},
    {"Water",
     output,
     "[groundwater]\n[output]\n",
     80,
     2,
     {"unknown key 'groundwater' in the scene", "[water]", "'table'"}},
    {"Anchor", output, "[[anchor]]\n[output]\n", 80, 3, {"unknown key 'anchor' in the scene", "[[bolt]]"}},
    {"Quake", output, "[[earthquake]]\n[output]\n", 80, 3, {"unknown key 'earthquake'", "[[quake]]"}},
    {"Domain",
     output,
     "[joint_set]\n[output]\n",
     80,
     2,
     {"unknown key 'joint_set'", "belong to [domain]", "[[domain.joint_set]]"}},
    {"AccelerationOfSupport",
     "axes = \"x\"",
     "axes = \"x\"\nacceleration = [1, 0]",
     49,
     1,
     {"'acceleration' in [[support]]", "'acceleration_history'"}},
    {"Points", "name = \"slider\"", "points = 3", 34, 1, {"'points' in [[block]]", "'vertices'"}},
};

class GuessedKeys : public testing::TestWithParam<Case> {};

TEST_P(GuessedKeys, AreRefusedWithWhatThereIs) {
  const Case& c = GetParam();
  std::string text(complete);
  const std::size_t at = text.find(c.from);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, std::string_view(c.from).size(), c.to);
  const SceneReading reading = read(text);
  ASSERT_FALSE(reading.scene);
  const Problem* found = nullptr;
  for (const Problem& problem : reading.problems)
    if (problem.line == c.line && problem.column == c.column) found = &problem;
  ASSERT_TRUE(found) << all_text(reading.problems);
  for (const char* word : c.words)
    EXPECT_NE(found->text().find(word), std::string::npos) << word << " in " << found->text();
}

INSTANTIATE_TEST_SUITE_P(All, GuessedKeys, testing::ValuesIn(cases),
                         [](const auto& of_case) { return of_case.param.name; });

TEST(GuessedKeys, AreToldOfSettingsToo) {
  for (const auto& [setting, words] :
       {std::pair{"joint.interface.kn=3", "rigid"}, std::pair{"groundwater.level=3", "[water]"}}) {
    const SceneReading reading = read(complete, {setting});
    ASSERT_EQ(reading.problems.size(), 1u) << all_text(reading.problems);
    EXPECT_NE(reading.problems[0].text().find(words), std::string::npos) << reading.problems[0].text();
  }
}

/// A key that a table has is never among those guessed there.
TEST(GuessedKeys, AreNotKeysOfTheirTable) {
  for (const CatalogEntry& entry : catalog()) {
    EXPECT_EQ(cure_of_guessed_key(entry.name, "the scene"), "") << entry.name;
    const std::string name(entry.name),
        title = entry.kind == CatalogEntry::Kind::tables ? "[[" + name + "]]" : "[" + name + "]";
    for (const std::string_view key : entry.keys)
      EXPECT_EQ(cure_of_guessed_key(key, title), "") << title << ' ' << key;
  }
  EXPECT_EQ(cure_of_guessed_key("", "[contact]"), "");
  EXPECT_EQ(cure_of_guessed_key("kn ks", "[contact]"), "");
  EXPECT_EQ(cure_of_guessed_key("nothing", "[contact]"), "");
}

}  // namespace
