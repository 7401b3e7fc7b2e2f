/// \file The JSON schema and the declarations of the keys say the same.
#include <gtest/gtest.h>
#include <ddacontact/scene/catalog.hpp>
#include <ddacontact/scene/json_schema.hpp>
#include <nlohmann/json.hpp>

namespace {

using namespace ddacontact::scene_format;
using nlohmann::json;

json properties() {
  return json::parse(json_schema())["properties"];
}

/// Of [NAME], or of an element of [[NAME]].
json table(const std::string& name) {
  const json entry = properties()[name];
  return entry["type"] == "array" ? entry["items"] : entry;
}

TEST(JsonSchema, HasEveryTableOfTheCatalogAsATableOrAList) {
  for (const CatalogEntry& entry : catalog()) {
    const json property = properties()[std::string(entry.name)];
    ASSERT_TRUE(property.is_object()) << entry.name;
    const bool is_key = entry.kind == CatalogEntry::Kind::key,
               is_list = entry.kind == CatalogEntry::Kind::tables;
    if (is_key) continue;
    EXPECT_EQ(property["type"] == "array", is_list) << entry.name;
    EXPECT_EQ(table(std::string(entry.name))["additionalProperties"], false) << entry.name;
  }
}

TEST(JsonSchema, HasBoundsWordsAndRequiredKeys) {
  const json angle = table("joint")["properties"]["friction_angle"];
  EXPECT_EQ(angle["minimum"], 0);
  EXPECT_EQ(angle["exclusiveMaximum"], 90);
  EXPECT_EQ(angle["type"], json({"number", "string"}));
  EXPECT_EQ(table("analysis")["properties"]["mode"]["enum"], json({"dynamic", "static"}));
  EXPECT_EQ(table("analysis")["required"], json({"time_step"}));
  EXPECT_EQ(table("material")["required"], json({"name", "young", "poisson"}));
  EXPECT_EQ(table("domain")["properties"]["joint_set"]["items"]["required"], json({"angle", "spacing"}));
}

TEST(JsonSchema, TakesBlocksFromAnyOfTheirThreeSources) {
  const json schema = json::parse(json_schema());
  EXPECT_EQ(schema["required"], json({"analysis", "material"}));
  EXPECT_EQ(schema["anyOf"].size(), 3u);
}

}  // namespace
