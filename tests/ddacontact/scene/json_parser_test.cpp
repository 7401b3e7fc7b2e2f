#include <ddacontact/scene/json_parser.hpp>

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace ddacontact;
using namespace ddacontact::scene_format;

std::optional<JsonTree> parse(const std::string& text) {
  ProblemList problems("test");
  std::optional<JsonTree> tree = parse_json(text, nullptr, problems);
  EXPECT_EQ(tree.has_value(), !problems.has_errors());
  return tree;
}

TEST(JsonParser, HoldsEveryKindOfValue) {
  const auto tree = parse(R"({"a": [1, -2.5e1, true, false, null], "b\n": "\u00e9\"]", "c": {}, "d": []})");
  const JsonValue root = JsonValue(*tree);
  ASSERT_TRUE(root.is(JsonKind::object));
  ASSERT_EQ(root.members().size(), 4u);
  EXPECT_EQ(root.members()[1].key, "b\n");
  const auto a = root.find("a")->elements();
  ASSERT_EQ(a.size(), 5u);
  EXPECT_EQ(a[0].number(), 1);
  EXPECT_EQ(a[1].number(), -25);
  EXPECT_TRUE(a[2].is(JsonKind::boolean) && a[2].number() == 1);
  EXPECT_TRUE(a[3].is(JsonKind::boolean) && a[3].number() == 0);
  EXPECT_TRUE(a[4].is(JsonKind::null));
  EXPECT_EQ(root.find("b\n")->text(), "\u00e9\"]");
  EXPECT_TRUE(root.find("c")->is(JsonKind::object) && root.find("c")->members().empty());
  EXPECT_TRUE(root.find("d")->is(JsonKind::array) && root.find("d")->elements().empty());
  EXPECT_FALSE(root.find("e"));
}

TEST(JsonParser, LargeWholeNumbersAreNumbers) {
  const auto tree = parse("[18446744073709551615, -9223372036854775808, 1000000000000000000000000]");
  const auto values = JsonValue(*tree).elements();
  EXPECT_EQ(values[0].number(), 18446744073709551615.0);
  EXPECT_EQ(values[1].number(), -9223372036854775808.0);
  EXPECT_EQ(values[2].number(), 1e24);
}

/// Writes a random value and notes, value by value, where it began.
class RandomText {
 public:
  explicit RandomText(unsigned seed) : random_(seed) {}

  void value(int depth) {
    blanks();
    locations.emplace_back(line_, column_);
    const auto choice = depth > 4 ? below(4) : below(6);
    if (choice == 4) return list(depth, '[', ']', false);
    if (choice == 5) return list(depth, '{', '}', true);
    static const std::vector<std::string> scalars[] = {{"1", "-2.5e-3", "0", "123456789"},
                                                       {"true", "false"},
                                                       {"null"},
                                                       {R"("")", R"("\\\"[")", "\"\u00e9,:\""}};
    const auto& words = scalars[choice];
    put(words[below(static_cast<int>(words.size()))]);
  }

  std::string text;
  std::vector<std::pair<int, int>> locations;

 private:
  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  void list(int depth, char open, char close, bool keys) {
    put(std::string(1, open));
    const int size = below(4);
    for (int k = 0; k < size; ++k) {
      if (k > 0) put(",");
      blanks();
      if (keys) put("\"k" + std::to_string(k) + "\"");
      blanks();
      if (keys) put(":");
      value(depth + 1);
      blanks();
    }
    put(std::string(1, close));
  }
  void blanks() {
    for (int k = below(4); k > 0; --k) put(below(3) == 0 ? "\n" : below(2) == 0 ? " " : "\t");
  }
  void put(const std::string& part) {
    text += part;
    for (const char c : part) {
      if (c == '\n') {
        ++line_;
        column_ = 1;
      } else if ((static_cast<unsigned char>(c) & 0xc0) != 0x80) {
        ++column_;
      }
    }
  }

  std::mt19937 random_;
  int line_ = 1, column_ = 1;
};

void collect_places(const JsonValue& value, std::vector<std::pair<int, int>>& locations) {
  locations.emplace_back(value.location().line, value.location().column);
  if (value.is(JsonKind::array))
    for (const JsonValue& element : value.elements()) collect_places(element, locations);
  if (value.is(JsonKind::object))
    for (const JsonMember& member : value.members()) collect_places(member.value, locations);
}

TEST(JsonParser, EveryValueKnowsWhereItStands) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    RandomText random(seed);
    random.value(0);
    for (const char* mark : {"", "\xef\xbb\xbf"}) {
      const auto tree = parse(mark + random.text);
      ASSERT_TRUE(tree) << random.text;
      std::vector<std::pair<int, int>> locations;
      collect_places(JsonValue(*tree), locations);
      EXPECT_EQ(locations, random.locations) << random.text;
    }
  }
}

TEST(JsonParser, DeepNestingIsRefused) {
  EXPECT_TRUE(parse(std::string(64, '[') + std::string(64, ']')));
  EXPECT_FALSE(parse(std::string(65, '[') + std::string(65, ']')));
  EXPECT_FALSE(parse(std::string(1000000, '[')));
}

TEST(JsonParser, ManyKeysAreFoundDistinctInTime) {
  std::string text = "{";
  for (int k = 0; k < 200000; ++k) text += "\"k" + std::to_string(k) + "\":0,";
  EXPECT_TRUE(parse(text + "\"end\":0}"));
  EXPECT_FALSE(parse(text + "\"k7\":0}"));
}

}  // namespace
