/// \file Reads one table of a scene file into its record, key by key as schema.hpp declares them.
#pragma once

#include <ddacontact/scene/toml_value.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ddacontact::scene_format {

class TableReader {
 public:
  /// `title` is what the table is called in messages: "[contact]", "[[block]]".
  TableReader(const toml::table& table, std::string_view title, Places& places, ProblemList& problems)
      : table_(table), title_(title), places_(places), problems_(problems) {}

  template <class T>
  void operator()(const Key& key, T& value) {
    if (const toml::node* node = find(key))
      read(key, *node, value);
    else if (key.required)
      missing(key, expected_text(key, value));
  }

  template <class T>
  void operator()(const Key& key, std::optional<T>& value) {
    const toml::node* node = find(key);
    if (!node) return;
    value.emplace();
    read(key, *node, *value);
  }

  void operator()(const Key& key, OfTheWholeRun);
  void operator()(const Key& key, OfStages);
  void operator()(const Key& key, NotInThisVersion not_here);
  void operator()(const Key& key, Skips& skips);
  void operator()(const Key& key, std::vector<JointChange>& changes);

  /// To be called after all keys: complains about those that no one asked for.
  void refuse_other_keys();

 protected:
  /// The value of a key, or null; notes that the key is known.
  const toml::node* find(const Key& key) {
    known_.emplace_back(key.name);
    return table_.get(key.name);
  }
  template <class T>
  void read(const Key& key, const toml::node& node, T& value) {
    const bool good = ValueReader(key, problems_)(node, value);
    places_.add(key.name, place_of(node, problems_), good);
  }
  void missing(const Key& key, const std::string& expected);
  /// A key that the table must not have.
  void refuse(const Key& key, const std::string& what, const std::string& cure);

  const toml::table& table_;
  std::string_view title_;
  Places& places_;
  ProblemList& problems_;
  std::vector<std::string_view> known_;
};

}  // namespace ddacontact::scene_format
