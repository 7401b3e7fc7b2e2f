/// \file Every way in which a scene or a geometry file may be wrong that the readers know, from
/// bad_input.txt: the place and the words of the problem.
#include "geometry_scenes.hpp"

#include <algorithm>
#include <ostream>

namespace {

using namespace geometry_scenes;

/// A row of the file.
struct Case {
  std::string section, name;
  std::string from, to;  ///< in the good text of the section
  int line = 0, column = 0;
  bool alone = true;               ///< no other problem follows from it
  std::vector<std::string> words;  ///< all stand in the message
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.section << ' ' << c.name;
}

std::vector<std::string> split(std::string_view text, std::string_view separator) {
  std::vector<std::string> parts;
  for (std::size_t end; (end = text.find(separator)) != text.npos; text.remove_prefix(end + separator.size()))
    parts.emplace_back(text.substr(0, end));
  parts.emplace_back(text);
  return parts;
}

/// `\n`, `\\` and `\xff` replaced by what they stand for.
std::string unescaped(std::string_view text) {
  std::string result;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] != '\\')
      result += text[k];
    else if (text[++k] == 'x') {
      result += static_cast<char>(std::stoi(std::string(text.substr(k + 1, 2)), nullptr, 16));
      k += 2;
    } else
      result += text[k] == 'n' ? '\n' : text[k];
  }
  return result;
}

std::vector<Case> cases_of_file() {
  std::vector<Case> cases;
  std::ifstream file(BAD_INPUT);
  std::string section;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('[')) section = line.substr(1, line.find(']') - 1);
    if (line.empty() || line.starts_with('[') || line.starts_with('#')) continue;
    const std::vector<std::string> cells = split(line, " | ");
    const std::vector<std::string> place = split(cells.at(1), ":");
    cases.push_back({section, cells.at(0), unescaped(cells.at(2)), unescaped(cells.at(3)),
                     std::stoi(place.at(0)), std::stoi(place.at(1)), !place.at(1).ends_with('+'),
                     split(cells.at(4), " & ")});
  }
  return cases;
}

class BadInput : public GeometryScenes, public testing::WithParamInterface<Case> {
 protected:
  SceneReading read_section(const std::string& section, const Case* c) const {
    const auto text = [&](std::string_view good) {
      return c != nullptr ? replaced(good, c->from, c->to) : std::string(good);
    };
    if (section == "geojson" || section == "wkt")
      return read_with("wall." + section, text(section == "wkt" ? good_wkt : good_json));
    return read(text(section == "stage"     ? in_stages
                     : section == "bolt"    ? std::string_view(row_of_three)
                     : section == "grouted" ? std::string_view(grouted)
                                            : complete));
  }
};

TEST_P(BadInput, IsRefusedAtItsPlaceWithItsWords) {
  const Case& c = GetParam();
  ASSERT_TRUE(read_section(c.section, nullptr).scene);
  const SceneReading reading = read_section(c.section, &c);
  EXPECT_FALSE(reading.scene);
  EXPECT_EQ(reading.unreadable, c.name == "NoGeometryFile");
  ASSERT_FALSE(reading.problems.empty());
  EXPECT_EQ(reading.problems.size() == 1, c.alone) << all_text(reading.problems);
  const Problem& problem = reading.problems.front();
  EXPECT_EQ(problem.severity, Problem::Severity::error);
  EXPECT_EQ(problem.file,
            c.section == "geojson" || c.section == "wkt" ? path("wall." + c.section) : "scene.toml");
  EXPECT_EQ(problem.line, c.line) << problem.text();
  EXPECT_EQ(problem.column, c.column) << problem.text();
  EXPECT_FALSE(problem.cure.empty()) << problem.text();
  for (const std::string& word : c.words)
    EXPECT_NE(problem.text().find(word), std::string::npos) << word << " in " << problem.text();
}

INSTANTIATE_TEST_SUITE_P(All, BadInput, testing::ValuesIn(cases_of_file()),
                         [](const auto& test) { return test.param.section + '_' + test.param.name; });

TEST(BadInput, IsAllRead) {
  EXPECT_GT(cases_of_file().size(), 380u);
}

}  // namespace
