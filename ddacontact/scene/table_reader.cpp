#include <ddacontact/scene/guessed_keys.hpp>
#include <ddacontact/scene/schema.hpp>
#include <ddacontact/scene/spelling.hpp>
#include <ddacontact/scene/table_reader.hpp>

#include <algorithm>

namespace ddacontact::scene_format {

void TableReader::operator()(const Key& key, OfTheWholeRun) {
  refuse(key, "in " + std::string(title_) + " belongs to the whole run", "write it in [analysis]");
}

void TableReader::operator()(const Key& key, OfStages) {
  if (!table_.get(key.name)) return;
  refuse(key, "in " + std::string(title_) + " belongs to a stage",
         "write joints = { NAME = { " + std::string(key.name) + " = true } } in the [[stage]]");
}

void TableReader::operator()(const Key& key, Skips& skips) {
  const toml::node* node = find(key);
  if (!node) return;
  const toml::table* table = node->as_table();
  locations_.add(key.name, location_of(*node, problems_), table != nullptr);
  if (!table)
    return problems_.error(location_of(*node, problems_),
                           "'" + std::string(key.name) + "' is " + description_of(*node),
                           "expected " + type_text(skips));
  const std::string quoted_title = "'" + std::string(key.name) + "'";
  KeyLocations locations;
  TableReader reader(*table, quoted_title, locations, problems_);
  describe(skips, reader);
  reader.known_.emplace_back("stale_factor");  // without effect: the scenes that older results keep have it
  reader.refuse_other_keys();
}

void TableReader::operator()(const Key& key, std::vector<JointChange>& changes) {
  const toml::node* node = find(key);
  if (!node) return;
  const toml::table* joints = node->as_table();
  locations_.add(key.name, location_of(*node, problems_), joints != nullptr);
  const auto wrong_type = [&](const toml::node& of, const std::string& name, const std::string& expected) {
    problems_.error(location_of(of, problems_), "'" + name + "' is " + description_of(of),
                    "expected " + expected);
  };
  if (!joints) return wrong_type(*node, key.name, type_text(changes));
  for (const auto& [name, of_joint] : *joints) {
    const std::string title = std::string(key.name) + '.' + excerpt(name.str());
    const toml::table* law = of_joint.as_table();
    if (!law) {
      wrong_type(of_joint, title, type_text(JointChange{}));
      continue;
    }
    JointChange& change = changes.emplace_back();
    change.joint.name = name.str();
    change.locations.table = location_of(name, problems_);
    const std::string quoted_title = "'" + title + "'";
    TableReader reader(*law, quoted_title, change.locations, problems_);
    describe_change(change, reader);
    reader.refuse_other_keys();
  }
}

void TableReader::missing_key(const std::string& name, const std::string& expected) {
  missing_.push_back({name, expected, "missing key '" + name + "' in " + std::string(title_),
                      "add '" + name + "': " + expected});
}

std::string TableReader::cure_of_unknown(std::string_view name) {
  const auto meant =
      std::ranges::find_if(missing_, [&](const MissingKey& m) { return is_near(name, m.name); });
  if (meant != missing_.end()) {
    const std::string cure = "write '" + meant->name + "': " + meant->expected;
    missing_.erase(meant);
    return cure;
  }
  // TOML gives a key written after a table to that table: what belongs to the top of the file is easily
  // misplaced.
  for (const std::string_view top : {"format", "title", "blocks"})
    if (name == top)
      return "'" + std::string(top) + "' belongs to the top of the file, before the first table";
  const std::string cure = cure_of_unknown_key(name, title_, known_);
  std::erase_if(missing_, [&](const MissingKey& m) { return cure.starts_with("write '" + m.name + "'"); });
  return cure;
}

void TableReader::refuse_other_keys() {
  for (const auto& [name, node] : table_) {
    if (std::find(known_.begin(), known_.end(), name.str()) != known_.end()) continue;
    const std::string cure = cure_of_unknown(name.str());
    problems_.error(location_of(name, problems_),
                    "unknown key '" + excerpt(name.str()) + "' in " + std::string(title_), cure);
    // The key that it was meant to be is neither missing nor left out.
    const auto meant = std::ranges::find_if(known_, [&](std::string_view key) {
      return is_near(name.str(), key) || cure.starts_with("write '" + std::string(key) + "'");
    });
    if (meant != known_.end() && !locations_.written(*meant))
      locations_.add(meant->data(), location_of(name, problems_), false);
  }
  for (const MissingKey& key : missing_) problems_.error(locations_.table, key.what, key.cure);
}

void TableReader::refuse(const Key& key, const std::string& what, const std::string& cure) {
  if (!find(key)) return;
  for (const auto& [name, node] : table_)
    if (name == key.name)
      problems_.error(location_of(name, problems_), "'" + std::string(key.name) + "' " + what, cure);
}

}  // namespace ddacontact::scene_format
