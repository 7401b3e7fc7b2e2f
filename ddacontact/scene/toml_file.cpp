#include <ddacontact/scene/spelling.hpp>
#include <ddacontact/scene/text.hpp>
#include <ddacontact/scene/toml_file.hpp>

#include <algorithm>
#include <cstddef>

namespace ddacontact::scene_format {

namespace {

/// Dotted keys of more parts than this are refused before parsing: the parser recurses into each part.
constexpr int longest_dotted_key = 16;

bool is_key_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
         c == ' ' || c == '\t';
}

/// The end of the string that starts at `i`: after its closing quotes, or of the line or text without these.
std::size_t end_of_string(std::string_view text, std::size_t i) {
  const char quote = text[i];
  const auto closes = [&](std::size_t k, std::size_t quotes) {
    return text.substr(k, quotes) == std::string(quotes, quote);
  };
  const std::size_t quotes = closes(i, 3) ? 3 : 1;
  for (i += quotes; i < text.size(); ++i) {
    if (text[i] == '\\' && quote == '"') {
      ++i;
    } else if (closes(i, quotes)) {
      i += quotes;
      for (int extra = 0; quotes == 3 && extra < 2 && i < text.size() && text[i] == quote; ++extra) ++i;
      return i;
    } else if (quotes == 1 && text[i] == '\n') {
      return i;
    }
  }
  return text.size();
}

/// The line of a key with too many parts, 0 without one.
int find_long_key(std::string_view text) {
  int dots = 0;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      i = end_of_string(text, i);
      continue;
    }
    if (c == '#') {
      i = std::min(text.find('\n', i), text.size());
      continue;
    }
    if (c == '.') {
      if (++dots >= longest_dotted_key)
        return 1 + static_cast<int>(
                       std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(i), '\n'));
    } else if (!is_key_character(c)) {
      dots = 0;
    }
    ++i;
  }
  return 0;
}

SourceLocation place_in(const toml::source_region& region, const ProblemList& problems) {
  if (region.path && *region.path != problems.file()) return {region.path, 1, 1};
  return {nullptr, std::max(1, static_cast<int>(region.begin.line)),
          std::max(1, static_cast<int>(region.begin.column))};
}

/// The node itself, or the first element (of an element) that comes from another source.
const toml::node& changed_part(const toml::node& node, int depth) {
  if (const toml::array* array = node.as_array(); array && depth > 0)
    for (const toml::node& element : *array) {
      const toml::node& part = changed_part(element, depth - 1);
      if (part.source().path != node.source().path) return part;
    }
  return node;
}

/// The column of the key, where the parser names that of the value: the last time 'KEY' stands before it.
int column_of_key(const std::string& text, const toml::source_position& position, std::string_view message) {
  const auto open = message.find('\''), close = message.rfind('\'');
  if (open == std::string_view::npos || close <= open + 1) return static_cast<int>(position.column);
  const std::string_view key = message.substr(open + 1, close - open - 1);
  std::size_t begin = 0;
  for (unsigned line = 1; line < position.line && begin != std::string::npos; ++line)
    begin = text.find('\n', begin) + 1;
  const std::string_view before =
      std::string_view(text).substr(std::min(begin, text.size()), position.column - 1);
  const auto found =
      before.rfind(key.substr(key.rfind('.') == std::string_view::npos ? 0 : key.rfind('.') + 1));
  return found == std::string_view::npos ? static_cast<int>(position.column) : static_cast<int>(found) + 1;
}

void add_syntax_error(const toml::parse_error& error, const std::string& text, ProblemList& problems) {
  const std::string what(error.description());
  SourceLocation location = place_in(error.source(), problems);
  std::string cure = "the file is read no further: correct this first";
  if (what.find("cannot redefine") != std::string::npos) {
    cure = "a key or table may be written once; several of a kind are [[block]], [[material]], ...";
    if (!location.source) location.column = column_of_key(text, error.source().begin, what);
  } else if (what.find("utf-8") != std::string::npos) {
    cure = "save the file as UTF-8";
  } else if (what.find("expected a comment or whitespace") != std::string::npos) {
    cure = "one key = value a line; a quantity with its unit stands in quotes: \"5 cm\"";
  }
  problems.error(location, "not TOML: " + what, cure);
}

}  // namespace

std::optional<toml::table> parse_toml(const std::string& text, const std::string& source,
                                      ProblemList& problems) {
  if (const int line = find_long_key(text)) {
    problems.error({nullptr, line, 1}, "key of more than " + std::to_string(longest_dotted_key) + " parts",
                   "no key of a scene has more than three");
    return std::nullopt;
  }
  try {
    return toml::parse(text, source);
  } catch (const toml::parse_error& error) {
    add_syntax_error(error, text, problems);
    return std::nullopt;
  }
}

SourceLocation location_of(const toml::node& node, const ProblemList& problems) {
  return place_in(changed_part(node, 2).source(), problems);
}

SourceLocation location_of(const toml::key& key, const ProblemList& problems) {
  return place_in(key.source(), problems);
}

std::string literal_of(const toml::node& node) {
  if (const auto* text = node.as_string()) return excerpt(text->get());
  if (const auto* number = node.as_integer()) return std::to_string(number->get());
  if (const auto* number = node.as_floating_point()) {
    const std::string digits = short_number(number->get());
    return digits.find_first_of(".en") == std::string::npos ? digits + ".0" : digits;
  }
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  return {};
}

std::string description_of(const toml::node& node) {
  if (node.is_string()) return "the string '" + literal_of(node) + "'";
  if (node.is_integer()) return "the whole number '" + literal_of(node) + "'";
  if (node.is_floating_point()) return "the number '" + literal_of(node) + "'";
  if (node.is_boolean()) return "the word '" + literal_of(node) + "'";
  if (const auto* array = node.as_array())
    return array->size() == 1 ? "an array of one element"
                              : "an array of " + std::to_string(array->size()) + " elements";
  return node.is_table() ? "a table" : "a date or time";
}

}  // namespace ddacontact::scene_format
