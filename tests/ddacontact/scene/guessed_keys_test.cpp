// Keys of other programs: one message that says what to write, or that this version has no such thing.
#include "example_scenes.hpp"

#include <ddacontact/scene/catalog.hpp>
#include <ddacontact/scene/guessed_keys.hpp>

namespace {

using namespace example_scenes;
using namespace ddacontact::scene_format;

TEST(GuessedKeys, AreToldOfSettingsToo) {
  for (const auto& [setting, words] :
       {std::pair{"joint.interface.kn=3", "rigid"}, std::pair{"groundwater.level=3", "[water]"},
        std::pair{"version=1", "'format' = 1"}}) {
    const SceneReading reading = read(complete, {setting});
    ASSERT_EQ(reading.problems.size(), 1u) << all_text(reading.problems);
    EXPECT_NE(reading.problems[0].text().find(words), std::string::npos) << reading.problems[0].text();
  }
}

/// A key of another table is told where it belongs; one of many tables by what is near.
TEST(GuessedKeys, OfOtherTablesAreToldWhereTheyBelong) {
  const std::vector<std::string_view> known{"steps", "scheme"};
  EXPECT_EQ(cure_of_unknown_key("skip", "the scene", known), "it belongs to [solver]");
  EXPECT_EQ(cure_of_unknown_key("restitution", "[analysis]", known), "it belongs to [[joint]]");
  EXPECT_EQ(cure_of_unknown_key("young", "[contact]", known), "it belongs to [[material]] or [[bolt]]");
  EXPECT_EQ(cure_of_unknown_key("name", "[analysis]", known).rfind("the nearest known key is 'scheme'", 0),
            0u);
  EXPECT_EQ(cure_of_unknown_key("stepz", "[analysis]", known), "did you mean 'steps'?");
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
