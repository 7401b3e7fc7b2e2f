#include <ddacontact/scene/json_parser.hpp>
#include <ddacontact/scene/spelling.hpp>
#include <ddacontact/scene/text_cursor.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <unordered_map>

namespace ddacontact::scene_format {

namespace {

constexpr std::size_t deepest_nesting = 64;

/// What the parser says, without its own way of naming the place and the last token.
std::string plain_message(std::string message) {
  if (const auto number = message.find("] "); number != std::string::npos) message.erase(0, number + 2);
  if (message.starts_with("parse error"))
    if (const auto location = message.find(": "); location != std::string::npos)
      message.erase(0, location + 2);
  const auto token = message.find("; last read: '"), expected = message.rfind("; expected ");
  if (token != std::string::npos)
    message.erase(token,
                  expected != std::string::npos && expected > token ? expected - token : std::string::npos);
  return message;
}

/// What stands around `offset` between blanks and signs, or the sign there; empty at the end.
std::string_view word_at(std::string_view text, std::size_t offset) {
  constexpr std::string_view ends = " \t\r\n,:[]{}";
  const auto is_end = [&](std::size_t i) { return ends.find(text[i]) != std::string_view::npos; };
  if (offset >= text.size()) return text.substr(text.size());
  if (is_end(offset)) return text.substr(offset, 1);
  std::size_t begin = offset, end = offset;
  while (begin > 0 && !is_end(begin - 1)) --begin;
  while (end < text.size() && !is_end(end)) ++end;
  return text.substr(begin, end - begin);
}

std::string cure(std::string_view word, std::string_view what) {
  if (word.empty()) return "the file ends too early";
  if (what.find("UTF-8") != std::string_view::npos) return "save the file as UTF-8";
  for (const std::string_view name : {"NaN", "Infinity", "-Infinity"})
    if (word == name) return "JSON knows finite numbers alone";
  return "the file is read no further: correct this first";
}

/// Takes the events of the parser, which come in the order of the text; a cursor follows them from token to
/// token, because the parser tells locations of errors only.
class JsonTreeBuilder {
 public:
  JsonTreeBuilder(const std::string& text, JsonTree& tree, ProblemList& problems)
      : text_(text), cursor_(text), tree_(tree), problems_(problems) {
    // Every value but the whole stands behind one of these.
    tree_.nodes.reserve(1 + static_cast<std::size_t>(std::ranges::count_if(
                                text, [](char c) { return c == '[' || c == '{' || c == ',' || c == ':'; })));
  }

  using number_integer_t = nlohmann::json::number_integer_t;
  using number_unsigned_t = nlohmann::json::number_unsigned_t;
  using number_float_t = nlohmann::json::number_float_t;
  using string_t = nlohmann::json::string_t;
  using binary_t = nlohmann::json::binary_t;

  bool null() { return add(JsonKind::null); }
  bool boolean(bool value) { return add(JsonKind::boolean, value ? 1 : 0); }
  bool number_integer(number_integer_t value) { return add(JsonKind::number, static_cast<double>(value)); }
  bool number_unsigned(number_unsigned_t value) { return add(JsonKind::number, static_cast<double>(value)); }
  bool number_float(number_float_t value, const string_t&) { return add(JsonKind::number, value); }
  bool string(string_t& value) {
    add(JsonKind::string);
    tree_.nodes.back().text = index_of(value);
    return true;
  }
  bool binary(binary_t&) { return false; }
  bool key(string_t& value) { return string(value); }
  bool start_object(std::size_t) { return open(JsonKind::object); }
  bool end_object() {
    const int object = open_.back();
    close();
    return has_distinct_keys(object);
  }
  bool start_array(std::size_t) { return open(JsonKind::array); }
  bool end_array() { return close(); }

  bool parse_error(std::size_t position, const std::string&, const nlohmann::json::exception& error) {
    const std::string_view word = word_at(text_, std::max<std::size_t>(position, 1) - 1);
    TextCursor cursor(text_);
    cursor.advance_to(word.data() - text_.data());
    const std::string what = plain_message(error.what());
    problems_.error({tree_.source, cursor.line(), cursor.column()},
                    "not JSON" + (word.empty() ? "" : " at '" + excerpt(word) + "'") + ": " + what,
                    cure(word, what));
    return false;
  }

 private:
  /// Of a text among those of the tree. The first ones, keys among them, are kept once.
  int index_of(std::string& text) {
    constexpr std::size_t most_known = 100;
    const auto known = known_.find(text);
    if (known != known_.end()) return known->second;
    const int index = static_cast<int>(tree_.texts.size());
    if (known_.size() < most_known) known_.emplace(text, index);
    tree_.texts.push_back(std::move(text));
    return index;
  }

  bool add(JsonKind kind, double number = 0) {
    cursor_.skip_any_of(" \t\r\n,:");
    JsonTree::Node node{kind, cursor_.line(), cursor_.column(), static_cast<int>(tree_.nodes.size()) + 1};
    node.number = number;
    tree_.nodes.push_back(node);
    skip_token();
    return true;
  }

  void skip_token() {
    const char first = cursor_.peek();
    if (first == '[' || first == ']' || first == '{' || first == '}') return cursor_.advance();
    if (first != '"') return cursor_.skip_until_any_of(",:]} \t\r\n");
    cursor_.advance();
    while (!cursor_.at_end() && cursor_.peek() != '"') {
      if (cursor_.peek() == '\\') cursor_.advance();
      cursor_.advance();
    }
    cursor_.advance();
  }

  bool open(JsonKind kind) {
    add(kind);
    open_.push_back(static_cast<int>(tree_.nodes.size()) - 1);
    if (open_.size() <= deepest_nesting) return true;
    problems_.error(JsonValue(tree_, open_.back()).location(),
                    "JSON nested more than " + std::to_string(deepest_nesting) + " deep",
                    "no geometry needs more than ten");
    return false;
  }

  bool close() {
    tree_.nodes[open_.back()].end = static_cast<int>(tree_.nodes.size());
    open_.pop_back();
    cursor_.skip_any_of(" \t\r\n,");
    skip_token();
    return true;
  }

  /// Of the object that ends here: no key twice.
  bool has_distinct_keys(int object) {
    const auto& nodes = tree_.nodes;
    std::vector<int> keys;
    for (int key = object + 1; key != nodes[object].end; key = nodes[key + 1].end) keys.push_back(key);
    const auto name = [&](int key) -> const std::string& { return tree_.texts[nodes[key].text]; };
    std::stable_sort(keys.begin(), keys.end(), [&](int a, int b) { return name(a) < name(b); });
    const auto twice =
        std::adjacent_find(keys.begin(), keys.end(), [&](int a, int b) { return name(a) == name(b); });
    if (twice == keys.end()) return true;
    problems_.error(JsonValue(tree_, *(twice + 1)).location(),
                    "the key '" + excerpt(name(*twice)) + "' stands twice",
                    "write each key of an object once");
    return false;
  }

  const std::string& text_;
  TextCursor cursor_;
  JsonTree& tree_;
  ProblemList& problems_;
  std::vector<int> open_;
  std::unordered_map<std::string, int> known_;
};

}  // namespace

std::optional<JsonTree> parse_json(const std::string& text, std::shared_ptr<const std::string> source,
                                   ProblemList& problems) {
  JsonTree tree;
  tree.source = std::move(source);
  JsonTreeBuilder builder(text, tree, problems);
  if (!nlohmann::json::sax_parse(text, &builder)) return std::nullopt;
  return tree;
}

}  // namespace ddacontact::scene_format
