/// \file doc/scene_format.md and the declarations of the keys say the same. To renew its tables, run the
/// tests with POLYDDA_UPDATE_DOC=1 in the environment.
#include "geometry_scenes.hpp"

#include <ddacontact/scene/catalog.hpp>
#include <ddacontact/scene/documentation.hpp>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace {

using namespace geometry_scenes;
using namespace ddacontact::scene_format;

std::string document() {
  std::ostringstream text;
  text << std::ifstream(SCENE_FORMAT_DOC).rdbuf();
  return text.str();
}

/// The document with every part between <!-- keys: NAME --> and <!-- end --> as it should be.
std::string renewed(const std::string& text) {
  static const std::string open = "<!-- keys: ", close = "<!-- end -->";
  std::string result;
  std::size_t done = 0;
  for (std::size_t begin = text.find(open); begin != std::string::npos; begin = text.find(open, done)) {
    const std::size_t name = begin + open.size();
    const std::string table = text.substr(name, text.find(" -->", name) - name);
    const std::size_t line = text.find('\n', name) + 1;
    result += text.substr(done, line - done) + key_table(table == "top" ? "" : table);
    done = text.find(close, line);
  }
  return result + text.substr(done);
}

TEST(Documentation, TablesAreUpToDate) {
  const std::string text = document();
  ASSERT_FALSE(text.empty()) << SCENE_FORMAT_DOC;
  const std::string wanted = renewed(text);
  if (std::getenv("POLYDDA_UPDATE_DOC")) std::ofstream(SCENE_FORMAT_DOC) << wanted;
  EXPECT_EQ(document(), wanted) << "run with POLYDDA_UPDATE_DOC=1 to renew the tables";
}

TEST(Documentation, HasEveryTable) {
  const std::string text = document();
  EXPECT_NE(text.find("<!-- keys: top -->"), std::string::npos);
  for (const CatalogEntry& entry : catalog()) {
    if (entry.kind == CatalogEntry::Kind::key) continue;
    EXPECT_NE(text.find("<!-- keys: " + std::string(entry.name) + " -->"), std::string::npos) << entry.name;
    EXPECT_FALSE(key_table(std::string(entry.name)).empty());
  }
  EXPECT_EQ(key_table("nothing"), "");
}

/// The first example in this language.
std::string example(const std::string& language) {
  const std::string text = document(), open = "```" + language + "\n";
  const std::size_t begin = text.find(open) + open.size();
  return text.substr(begin, text.find("```", begin) - begin);
}

TEST(Documentation, ExampleIsAGoodScene) {
  const SceneReading reading = read(example("toml"));
  EXPECT_TRUE(reading.scene);
  EXPECT_EQ(all_text(reading.problems), "");
}

class GeometryDocumentation : public GeometryScenes {};

TEST_F(GeometryDocumentation, ExampleIsAGoodFile) {
  const Scene scene = scene_with("wall.geojson", example("json"));
  ASSERT_EQ(scene.blocks.size(), 2u);
  EXPECT_TRUE(scene.blocks[0].fixed);
  EXPECT_EQ(scene.blocks[1].model, ddacontact::BlockModel::affine);
}

}  // namespace
