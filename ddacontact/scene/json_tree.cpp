#include <ddacontact/scene/json_tree.hpp>
#include <ddacontact/scene/spelling.hpp>
#include <ddacontact/scene/text.hpp>

namespace ddacontact::scene_format {

std::vector<JsonValue> JsonValue::elements() const {
  std::vector<JsonValue> elements;
  for (int i = node_ + 1; i < node().end; i = tree_->nodes[i].end) elements.emplace_back(*tree_, i);
  return elements;
}

std::vector<JsonMember> JsonValue::members() const {
  std::vector<JsonMember> members;
  for (int i = node_ + 1; i < node().end; i = tree_->nodes[i + 1].end)
    members.push_back(
        {JsonValue(*tree_, i).text(), JsonValue(*tree_, i).location(), JsonValue(*tree_, i + 1)});
  return members;
}

std::optional<JsonValue> JsonValue::find(std::string_view key) const {
  for (int i = node_ + 1; i < node().end; i = tree_->nodes[i + 1].end)
    if (JsonValue(*tree_, i).text() == key) return JsonValue(*tree_, i + 1);
  return std::nullopt;
}

std::string JsonValue::description() const {
  switch (kind()) {
    case JsonKind::null:
      return "null";
    case JsonKind::boolean:
      return number() != 0 ? "the word 'true'" : "the word 'false'";
    case JsonKind::number:
      return "the number '" + short_number(number()) + "'";
    case JsonKind::string:
      return "the string '" + excerpt(text()) + "'";
    case JsonKind::array: {
      const std::size_t size = elements().size();
      return size == 1 ? "an array of one element" : "an array of " + std::to_string(size) + " elements";
    }
    case JsonKind::object:
      break;
  }
  return "an object";
}

}  // namespace ddacontact::scene_format
