#include "scene_list.hpp"

#include <ddacontact/output/csv_table.hpp>

#include <sstream>

namespace regression {

namespace {

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

std::pair<std::string, std::string> pair_from(const std::string& word) {
  const std::size_t slash = word.find('/');
  if (slash == std::string::npos) throw ddacontact::Error("\"" + word + "\" is no pair (write a/b)");
  return {word.substr(0, slash), word.substr(slash + 1)};
}

}  // namespace

std::vector<ListedScene> read_scene_list(const std::filesystem::path& file) {
  const ddacontact::CsvTable table(file);
  const auto names = table.texts("scene"), files = table.texts("file"), settings = table.texts("settings"),
             pairs = table.texts("pairs");
  std::vector<ListedScene> scenes;
  for (std::size_t row = 0; row < table.n_rows(); ++row) {
    ListedScene& scene = scenes.emplace_back();
    scene.name = names[row];
    scene.file = file.parent_path() / files[row];
    scene.settings = words_of(settings[row]);
    for (const std::string& word : words_of(pairs[row])) scene.pairs.push_back(pair_from(word));
  }
  return scenes;
}

}  // namespace regression
