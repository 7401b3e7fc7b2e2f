#include <ddacontact/scene/spelling.hpp>
#include <ddacontact/scene/table_reader.hpp>

#include <algorithm>

namespace ddacontact::scene_format {

void TableReader::operator()(const Key& key, NotAvailable) {
  if (!find(key)) return;
  for (const auto& [name, node] : table_) {
    if (name != key.name) continue;
    problems_.error(place_of(name, problems_), "'" + std::string(key.name) + "' is " + not_available_text,
                    "leave it out");
  }
}

namespace {

/// TOML gives a key written after a table to that table: what belongs to the top of the file is easily
/// misplaced.
std::string cure_of_unknown(std::string_view name, const std::vector<std::string_view>& known) {
  for (const std::string_view top : {"format", "title", "blocks"})
    if (name == top)
      return "'" + std::string(top) + "' belongs to the top of the file, before the first table";
  return suggestion(name, "key", known);
}

}  // namespace

void TableReader::refuse_other_keys() {
  for (const auto& [name, node] : table_) {
    if (std::find(known_.begin(), known_.end(), name.str()) != known_.end()) continue;
    problems_.error(place_of(name, problems_),
                    "unknown key '" + excerpt(name.str()) + "' in " + std::string(title_),
                    cure_of_unknown(name.str(), known_));
  }
}

void TableReader::missing(const Key& key, const std::string& expected) {
  problems_.error(places_.table, "missing key '" + std::string(key.name) + "' in " + std::string(title_),
                  "add '" + std::string(key.name) + "': " + expected);
}

}  // namespace ddacontact::scene_format
