#include <ddacontact/scene/parameters.hpp>

#include <ddacontact/scene/spelling.hpp>
#include <ddacontact/scene/text.hpp>

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace ddacontact::scene_format {

namespace {

constexpr std::string_view assigned = " = ";

/// Names, and values as text.
using Values = std::map<std::string, std::string, std::less<>>;

bool is_name(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

/// The value of a parameter as text; empty when it is no number.
std::string text_of(const toml::node& node) {
  if (const auto* whole = node.as_integer()) return std::to_string(whole->get());
  if (const auto* real = node.as_floating_point()) return number_text(real->get());
  if (const auto* quantity = node.as_string()) {
    const std::string& text = quantity->get();
    double value = 0;
    const bool begins = std::from_chars(text.data(), text.data() + text.size(), value).ec == std::errc();
    return begins ? text : "";
  }
  return "";
}

Values values_of(const toml::table& parameters, ProblemList& problems) {
  Values values;
  for (const auto& [key, node] : parameters) {
    const std::string name(key.str()), value = text_of(node);
    if (!is_name(name))
      problems.error(location_of(key, problems), "the parameter '" + excerpt(name) + "' has no good name",
                     "use letters, digits, '_' and '-'");
    else if (value.empty())
      problems.error(location_of(node, problems),
                     "the parameter '" + excerpt(name) + "' is " + description_of(node),
                     "write a number, or a string with its unit such as \"2 m\"");
    values.emplace(name, value.empty() ? "0" : value);
  }
  return values;
}

std::string_view value_of(std::string_view text) {
  return text.substr(text.find(assigned) + assigned.size());
}

class Substitution {
 public:
  Substitution(const Values& values, ProblemList& problems) : values_(values), problems_(problems) {}

  void visit(toml::node& node) {
    if (toml::table* table = node.as_table()) {
      for (auto&& [key, value] : *table)
        if (key != "title" && key != "name" && key != "parameters") visit(value);
    } else if (toml::array* array = node.as_array()) {
      for (toml::node& element : *array) visit(element);
    } else if (auto* text = node.as_string()) {
      replace(*text);
    }
  }

  /// Not told where a name is unknown: it may be the one that is meant.
  bool leaves_unused(std::string_view name) const { return !any_unknown_ && !used_.contains(name); }

 private:
  void replace(toml::value<std::string>& text) {
    const std::string_view written = text.get();
    if (!written.starts_with('$') || !is_name(written.substr(1))) return;
    if (const auto value = values_.find(written.substr(1)); value != values_.end()) {
      used_.insert(value->first);
      text = std::string(written) + std::string(assigned) + value->second;
      return;
    }
    any_unknown_ = true;
    std::vector<std::string_view> known;
    for (const auto& [name, value] : values_) known.push_back(name);
    problems_.error(
        location_of(text, problems_), "unknown parameter '" + excerpt(written) + "'",
        known.empty() ? "write it in [parameters]" : suggestion(written.substr(1), "parameter", known));
    text = std::string(written) + std::string(assigned);
  }

  const Values& values_;
  ProblemList& problems_;
  std::set<std::string, std::less<>> used_;
  bool any_unknown_ = false;
};

}  // namespace

void put_parameters(toml::table& root, ProblemList& problems) {
  const toml::table* parameters = root["parameters"].as_table();
  const Values values = parameters ? values_of(*parameters, problems) : Values();
  Substitution substitution(values, problems);
  substitution.visit(root);
  if (!parameters) return;
  for (const auto& [key, node] : *parameters)
    if (values.contains(key.str()) && substitution.leaves_unused(key.str()))
      problems.warning(location_of(key, problems), "the parameter '" + excerpt(key.str()) + "' is not used",
                       "write \"$" + excerpt(key.str()) + "\" where its value belongs, or leave it out");
}

bool is_parameter(std::string_view text) {
  return text.starts_with('$') && text.find(assigned) != std::string_view::npos;
}

bool is_unknown_parameter(const toml::node& node) {
  const auto* text = node.as_string();
  return text && is_parameter(text->get()) && text->get().ends_with(assigned);
}

QuantityReading read_parameter(std::string_view text, std::string_view unit, std::string_view other_unit) {
  const std::string_view value = value_of(text);
  double number = 0;
  const auto [end, status] = std::from_chars(value.data(), value.data() + value.size(), number);
  if (status == std::errc() && end == value.data() + value.size()) return {number, ""};
  return read_quantity(value, unit, other_unit);
}

std::optional<std::int64_t> whole_number(const toml::node& node) {
  if (const auto* whole = node.as_integer()) return whole->get();
  const auto* text = node.as_string();
  if (!text || !is_parameter(text->get())) return std::nullopt;
  const std::string_view value = value_of(text->get());
  std::int64_t number = 0;
  const auto [end, status] = std::from_chars(value.data(), value.data() + value.size(), number);
  if (status != std::errc() || end != value.data() + value.size()) return std::nullopt;
  return number;
}

}  // namespace ddacontact::scene_format
