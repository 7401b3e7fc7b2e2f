/// \file Reads one table of a scene file into its record, key by key as schema.hpp declares them.
#pragma once

#include <ddacontact/scene/parameters.hpp>
#include <ddacontact/scene/toml_value.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ddacontact::scene_format {

class TableReader {
 public:
  /// `title` is what the table is called in messages: "[contact]", "[[block]]".
  TableReader(const toml::table& table, std::string_view title, KeyLocations& locations,
              ProblemList& problems)
      : table_(table), title_(title), locations_(locations), problems_(problems) {}

  template <class T>
  void operator()(const Key& key, T& value) {
    if (const toml::node* node = find(key))
      read(key, *node, value);
    else if (key.required)
      missing_key(key.name, expected_text(key, value));
  }

  template <class T>
  void operator()(const Key& key, std::optional<T>& value) {
    const toml::node* node = find(key);
    if (!node) return;
    value.emplace();
    read(key, *node, *value);
  }

  /// [[TABLE.KEY]] for each.
  template <Inner Record>
  void operator()(const Key& key, std::vector<Record>& records) {
    const toml::node* node = find(key);
    if (!node) return;
    const std::size_t n_faults = problems_.n_faults();
    const std::string title = inner_title(key);
    if (const toml::array* array = node->as_array())
      for (const toml::node& element : *array) read_inner(element, title, records.emplace_back());
    else
      problems_.error(location_of(*node, problems_),
                      "'" + std::string(key.name) + "' is " + description_of(*node),
                      "write " + title + " for each");
    locations_.add(key.name, location_of(*node, problems_), problems_.n_faults() == n_faults);
  }
  /// KEY = { ... }
  template <Inner Record>
  void operator()(const Key& key, std::optional<Record>& record) {
    const toml::node* node = find(key);
    if (!node) return;
    const std::size_t n_faults = problems_.n_faults();
    read_inner(*node, "'" + std::string(key.name) + "'", record.emplace());
    locations_.add(key.name, location_of(*node, problems_), problems_.n_faults() == n_faults);
  }

  void operator()(const Key& key, OfTheWholeRun);
  void operator()(const Key& key, OfStages);
  void operator()(const Key& key, Skips& skips);
  void operator()(const Key& key, std::vector<JointChange>& changes);

  /// To be called after all keys: complains about unknown keys, and about missing ones that no unknown key
  /// was meant to be.
  void refuse_other_keys();

 protected:
  /// The value of a key, or null; notes that the key is known.
  const toml::node* find(const Key& key) {
    known_.emplace_back(key.name);
    return table_.get(key.name);
  }
  template <class T>
  void read(const Key& key, const toml::node& node, T& value) {
    const bool missing = is_unknown_parameter(node);
    if (missing) problems_.note_missing_value();
    const bool good = !missing && ValueReader(key, problems_)(node, value);
    locations_.add(key.name, location_of(node, problems_), good);
  }
  template <Inner Record>
  void read_inner(const toml::node& node, const std::string& title, Record& record) {
    const toml::table* table = node.as_table();
    if (!table)
      return problems_.error(location_of(node, problems_), title + " is " + description_of(node),
                             "expected " + type_text(record));
    record.locations.table = location_of(node, problems_);
    TableReader reader(*table, title, record.locations, problems_);
    describe(record, reader);
    reader.refuse_other_keys();
  }
  /// "[[domain.trace]]"
  std::string inner_title(const Key& key) const {
    return "[[" + std::string(title_.substr(1, title_.size() - 2)) + '.' + key.name + "]]";
  }
  void missing_key(const std::string& name, const std::string& expected);
  /// What to write for a key that is not known; a missing key that it was meant to be is missing no longer.
  std::string cure_of_unknown(std::string_view name);
  /// A key that the table must not have.
  void refuse(const Key& key, const std::string& what, const std::string& cure);

  const toml::table& table_;
  std::string_view title_;
  KeyLocations& locations_;
  ProblemList& problems_;
  std::vector<std::string_view> known_;
  struct MissingKey {
    std::string name, expected, what, cure;
  };
  std::vector<MissingKey> missing_;
};

}  // namespace ddacontact::scene_format
