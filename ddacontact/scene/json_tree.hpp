/// \file JSON text to a tree whose every value knows where it stands.
#pragma once

#include <ddacontact/scene/problem_list.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ddacontact::scene_format {

enum class JsonKind : char { null, boolean, number, string, array, object };

class JsonTree;
struct JsonMember;

/// A value of a tree, which must outlive it.
class JsonValue {
 public:
  JsonValue(const JsonTree& tree, int node) : tree_(&tree), node_(node) {}

  JsonKind kind() const;
  bool is(JsonKind other) const { return kind() == other; }
  Place place() const;
  double number() const;  ///< of a number; 1 and 0 stand for true and false
  const std::string& text() const;
  std::vector<JsonValue> elements() const;  ///< of an array
  std::vector<JsonMember> members() const;  ///< of an object, in the order of the text
  /// The first member of an object called `key`.
  std::optional<JsonValue> find(std::string_view key) const;

  /// In words, for messages: "the string 'abc'", "an array of 3 elements".
  std::string description() const;

 private:
  const JsonTree* tree_;
  int node_;
};

struct JsonMember {
  const std::string& key;
  Place place;  ///< of the key
  JsonValue value;
};

class JsonTree {
 public:
  /// Nothing and one problem when `text` is not JSON, repeats a key in an object, or is nested more than 64
  /// deep. `source` is what messages call the text.
  static std::optional<JsonTree> parse(const std::string& text, std::shared_ptr<const std::string> source,
                                       ProblemList& problems);

  JsonValue root() const { return {*this, 0}; }

 private:
  friend class JsonValue;
  friend class JsonTreeBuilder;

  /// Every value stands before its parts; the key of a member, as a string, before its value.
  struct Node {
    JsonKind kind;
    int line, column;
    int end;  ///< the first node that is no part of this one
    int text = -1;
    double number = 0;
  };

  std::shared_ptr<const std::string> source_;
  std::vector<Node> nodes_;
  std::vector<std::string> texts_;
};

}  // namespace ddacontact::scene_format
