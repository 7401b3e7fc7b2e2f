/// \file A tree of JSON values, each of which knows where it stands in its text.
#pragma once

#include <ddacontact/scene/problem_list.hpp>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ddacontact::scene_format {

enum class JsonKind : char { null, boolean, number, string, array, object };

/// The values in the order of the text: every value stands before its parts, the key of a member, as a
/// string, before its value. JsonValue reads it.
struct JsonTree {
  struct Node {
    JsonKind kind;
    int line, column;
    int end;            ///< the first node that is no part of this one
    int text = -1;      ///< of a string: its index
    double number = 0;  ///< 1 and 0 stand for true and false
  };

  std::shared_ptr<const std::string> source;  ///< what messages call the text
  std::vector<Node> nodes;
  std::vector<std::string> texts;
};

struct JsonMember;

/// A value of a tree, which must outlive it.
class JsonValue {
 public:
  /// `node` 0 is the whole text.
  explicit JsonValue(const JsonTree& tree, int node = 0) : tree_(&tree), node_(node) {}

  JsonKind kind() const { return node().kind; }
  bool is(JsonKind other) const { return kind() == other; }
  SourceLocation location() const { return {tree_->source, node().line, node().column}; }
  /// Of a number, or 1 and 0 for true and false.
  double number() const { return node().number; }
  /// Of a string.
  const std::string& text() const { return tree_->texts[node().text]; }
  std::vector<JsonValue> elements() const;  ///< of an array
  std::vector<JsonMember> members() const;  ///< of an object, in the order of the text
  /// The member of an object called `key`.
  std::optional<JsonValue> find(std::string_view key) const;

  /// In words, for messages: "the string 'abc'", "an array of 3 elements".
  std::string description() const;

 private:
  const JsonTree::Node& node() const { return tree_->nodes[node_]; }

  const JsonTree* tree_;
  int node_;
};

struct JsonMember {
  const std::string& key;
  SourceLocation location;  ///< of the key
  JsonValue value;
};

}  // namespace ddacontact::scene_format
