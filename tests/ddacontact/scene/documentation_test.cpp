/// \file doc/scene_format.md and the declarations of the keys say the same. To renew its tables, run the
/// tests with POLYDDA_UPDATE_DOC=1 in the environment.
#include "example_scenes.hpp"

#include <ddacontact/scene/catalog.hpp>
#include <ddacontact/scene/documentation.hpp>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace {

using namespace example_scenes;
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

TEST(Documentation, ExampleIsAGoodScene) {
  const std::string text = document();
  const std::size_t begin = text.find("```toml\n") + 8;
  const SceneReading reading = read(text.substr(begin, text.find("```", begin) - begin));
  EXPECT_TRUE(reading.scene);
  EXPECT_EQ(all_text(reading.problems), "");
}

}  // namespace
