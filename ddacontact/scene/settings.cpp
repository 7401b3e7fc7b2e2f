#include <ddacontact/scene/catalog.hpp>
#include <ddacontact/scene/guessed_keys.hpp>
#include <ddacontact/scene/settings.hpp>
#include <ddacontact/scene/spelling.hpp>
#include <ddacontact/scene/text.hpp>
#include <ddacontact/scene/toml_file.hpp>

#include <algorithm>
#include <charconv>
#include <memory>

namespace ddacontact::scene_format {

namespace {

using Path = std::vector<std::string>;

/// The parts of PATH and the text after '='; no parts when the setting has not that form.
std::pair<Path, std::string> split(const std::string& setting) {
  Path path{""};
  bool in_quotes = false;
  for (std::size_t i = 0; i < setting.size(); ++i) {
    const char c = setting[i];
    if (c == '"') {
      in_quotes = !in_quotes;
    } else if (!in_quotes && c == '=') {
      const bool complete =
          std::none_of(path.begin(), path.end(), [](const std::string& part) { return part.empty(); });
      return {complete ? path : Path{}, setting.substr(i + 1)};
    } else if (!in_quotes && c == '.') {
      path.emplace_back();
    } else if (in_quotes || (c != ' ' && c != '\t')) {
      path.back() += c;
    }
  }
  return {};
}

/// A table {v = VALUE}, where VALUE is taken as TOML or else as a string.
std::optional<toml::table> parse_value(const std::string& value, const std::string& source,
                                       ProblemList& problems) {
  ProblemList ignored("");
  std::optional<toml::table> table = parse_toml("v = " + value, source, ignored);
  if (table && table->size() == 1) return table;
  return parse_toml("v = " + scene_format::quoted(value), source, problems);
}

std::optional<std::size_t> index_of(const std::string& text) {
  std::size_t index = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), index);
  if (status != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return index;
}

class Setting {
 public:
  Setting(const std::string& text, ProblemList& problems)
      : text_(text),
        source_("--set " + text),
        location_{std::make_shared<const std::string>(source_), 1, 1},
        problems_(problems) {}

  void apply(toml::table& root) {
    auto [path, value_text] = split(text_);
    if (path.empty()) return refuse("'" + excerpt(text_) + "' is no setting", "write PATH=VALUE");
    path_ = std::move(path);
    std::optional<toml::table> value = parse_value(value_text, source_, problems_);
    if (!value) return;
    value_ = std::move(*value);

    std::vector<std::string_view> names;
    for (const CatalogEntry& entry : catalog()) names.push_back(entry.name);
    const auto known = std::find(names.begin(), names.end(), path_[0]);
    if (known == names.end()) return refuse_part(0, cure_of_unknown_key(path_[0], "the scene", names));
    const CatalogEntry& entry = catalog()[known - names.begin()];
    const toml::node* present = root.get(path_[0]);
    if (entry.kind == CatalogEntry::Kind::key && path_.size() > 1 && present && present->is_value())
      return refuse_part(1, "'" + path_[0] + "' has no elements");
    if (path_[0] == "parameters" && path_.size() == 2) return set_parameter(root);
    if (path_.size() > 1 && entry.kind == CatalogEntry::Kind::key && root.contains(path_[0]))
      return set_element(*root.get(path_[0]), 1);
    if (path_.size() == 1 || entry.kind == CatalogEntry::Kind::key) return put_wrapped(root, 0);
    if (toml::table* table = find_table(entry, root))
      set_key(entry, *table, entry.kind == CatalogEntry::Kind::tables ? 2 : 1);
  }

 private:
  void refuse(const std::string& what, const std::string& cure) { problems_.error(location_, what, cure); }
  void refuse_part(std::size_t part, const std::string& cure) {
    refuse("unknown '" + excerpt(path_[part]) + "' in the path of the setting", cure);
  }

  void set_parameter(toml::table& root) {
    toml::table* parameters = root["parameters"].as_table();
    std::vector<std::string_view> names;
    if (parameters)
      for (const auto& [name, node] : *parameters) names.push_back(name.str());
    if (std::find(names.begin(), names.end(), path_[1]) != names.end()) return put(*parameters, 1);
    refuse_part(1,
                names.empty() ? "the scene has no [parameters]" : suggestion(path_[1], "parameter", names));
  }

  /// The table that path_[0] names, made when the file has not got it; or the element path_[1] of an array.
  toml::table* find_table(const CatalogEntry& entry, toml::table& root) {
    toml::node* node = root.get(path_[0]);
    if (entry.kind == CatalogEntry::Kind::table) {
      if (!node) {
        root.insert(path_[0], toml::table{});
        node = root.get(path_[0]);
      }
      if (!node->is_table())
        refuse("'" + path_[0] + "' is not a table", "write [" + path_[0] + "] in the scene");
      return node->as_table();
    }
    toml::array* array = node ? node->as_array() : nullptr;
    if (!array || array->empty())
      refuse("the scene has no [[" + path_[0] + "]]", "only what is in the scene can be set" + beyond(root));
    else if (toml::table* element = find_element(*array))
      return element;
    else
      refuse_part(1, known_elements(*array) + beyond(root));
    return nullptr;
  }

  static const toml::value<std::string>* name_of(const toml::node& element) {
    const toml::table* table = element.as_table();
    return table && table->get("name") ? table->get("name")->as_string() : nullptr;
  }

  toml::table* find_element(toml::array& array) const {
    for (toml::node& element : array)
      if (const auto* name = name_of(element); name && name->get() == path_[1]) return element.as_table();
    const std::optional<std::size_t> index = index_of(path_[1]);
    return index && *index < array.size() ? array[*index].as_table() : nullptr;
  }

  /// What path_[1] could have been.
  std::string known_elements(const toml::array& array) const {
    std::vector<std::string_view> names;
    for (const toml::node& element : array)
      if (const auto* name = name_of(element)) names.emplace_back(name->get());
    if (index_of(path_[1]) || names.empty())
      return "indices run from 0 to " + std::to_string(array.size() - 1);
    return suggestion(path_[1], path_[0], names);
  }

  /// Blocks of a geometry file are no tables.
  std::string beyond(const toml::table& root) const {
    if (path_[0] != "block" || !root.contains("blocks")) return "";
    return "; settings do not reach the blocks of a geometry file: give the feature that property";
  }

  /// What messages call a table.
  static std::string title_of(const CatalogEntry& entry) {
    const std::string name(entry.name);
    return entry.kind == CatalogEntry::Kind::tables ? "[[" + name + "]]" : "[" + name + "]";
  }

  /// path_[part] is a key of `table`.
  void set_key(const CatalogEntry& entry, toml::table& table, std::size_t part) {
    if (part >= path_.size())
      return refuse("'" + excerpt(text_) + "' names no key", "write " + path_[0] + ".ELEMENT.KEY=VALUE");
    if (std::find(entry.keys.begin(), entry.keys.end(), path_[part]) == entry.keys.end())
      return refuse_part(part, cure_of_unknown_key(path_[part], title_of(entry), entry.keys));
    toml::node* value = table.get(path_[part]);
    if (part + 1 == path_.size() || !value) return put_or_refuse(table, part, value);
    set_element(*value, part + 1);
  }

  /// A key that is not written has no elements; as a table it is made.
  void put_or_refuse(toml::table& table, std::size_t part, const toml::node* value) {
    if (value || part + 1 == path_.size() || !index_of(path_[part + 1]) || !index_of(path_.back()))
      return put_wrapped(table, part);
    refuse("'" + path_[part] + "' is not in the scene, it has no element '" + excerpt(path_[part + 1]) + "'",
           "set '" + path_[part] + "' as a whole");
  }

  /// path_[part] is an index or a key inside a value.
  void set_element(toml::node& value, std::size_t part) {
    if (toml::table* table = value.as_table()) {
      toml::node* inner = table->get(path_[part]);
      if (part + 1 == path_.size() || !inner) return put_wrapped(*table, part);
      return set_element(*inner, part + 1);
    }
    toml::array* array = value.as_array();
    const std::optional<std::size_t> index = index_of(path_[part]);
    if (!array) return refuse_part(part, "'" + path_[part - 1] + "' has no elements");
    if (!index || *index >= array->size())
      return refuse_part(part, "'" + path_[part - 1] + "' has " + std::to_string(array->size()) +
                                   " elements, counted from 0");
    if (part + 1 < path_.size()) return set_element((*array)[*index], part + 1);
    value_.get("v")->visit([&](auto& typed) {
      array->replace(array->cbegin() + static_cast<std::ptrdiff_t>(*index), std::move(typed));
    });
  }

  /// Puts path_[part] into `table`, with tables for the parts after it.
  void put_wrapped(toml::table& table, std::size_t part) {
    for (std::size_t inner = path_.size() - 1; inner > part; --inner) wrap(inner);
    put(table, part);
  }

  /// The value becomes a table that holds it as path_[part].
  void wrap(std::size_t part) {
    toml::table outer = *parse_toml("v = {}", source_, problems_);
    put(*outer.get("v")->as_table(), part);
    value_ = std::move(outer);
  }

  void put(toml::table& table, std::size_t part) {
    toml::node& value = *value_.get("v");
    const toml::key key(path_[part], toml::source_region(value.source()));
    value.visit([&](auto& typed) { table.insert_or_assign(key, std::move(typed)); });
  }

  const std::string& text_;
  std::string source_;
  SourceLocation location_;
  ProblemList& problems_;
  Path path_;
  toml::table value_;
};

}  // namespace

void apply_settings(const std::vector<std::string>& settings, toml::table& root, ProblemList& problems) {
  for (const std::string& setting : settings) Setting(setting, problems).apply(root);
}

}  // namespace ddacontact::scene_format
