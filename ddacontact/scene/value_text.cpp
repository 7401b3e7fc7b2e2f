#include <ddacontact/scene/value_text.hpp>

#include <ddacontact/scene/schema.hpp>
#include <ddacontact/scene/text.hpp>

#include <algorithm>
#include <utility>

namespace ddacontact::scene_format {

namespace {

/// Keys and the texts of their values.
using Keys = std::vector<std::pair<std::string, std::string>>;

/// "{ a = 1, b = 2 }"
std::string table_text(const Keys& keys) {
  std::string text;
  for (const auto& [key, value] : keys) text += (text.empty() ? "{ " : ", ") + key + " = " + value;
  return text.empty() ? "{}" : text + " }";
}

/// In quotes where it needs them.
std::string key_text(const std::string& key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return bare ? key : quoted(key);
}

/// "[a, b]" of the texts of a range.
template <class Range>
std::string array_text(const Range& range) {
  std::string text = "[";
  for (const auto& value : range) text += (text.size() > 1 ? ", " : "") + value_text(value);
  return text + ']';
}

}  // namespace

std::string value_text(GradientCorrection value) {
  return value == GradientCorrection::on ? "true" : "false";
}
std::string value_text(bool value) {
  return value ? "true" : "false";
}
std::string value_text(int value) {
  return std::to_string(value);
}
std::string value_text(double value) {
  return number_text(value);
}
std::string value_text(const std::string& value) {
  return quoted(value);
}
std::string value_text(const RayleighDamping& value) {
  return table_text({{"mass", value_text(value.mass)}, {"stiffness", value_text(value.stiffness)}});
}
std::string value_text(const MeshRecord& value) {
  Keys keys;
  if (value.kind) keys.emplace_back("kind", value_text(*value.kind));
  if (value.cells) keys.emplace_back("cells", value_text(*value.cells));
  if (value.cell_size) keys.emplace_back("cell_size", value_text(*value.cell_size));
  if (value.edge_nodes) keys.emplace_back("edge_nodes", value_text(*value.edge_nodes));
  if (value.at_contact) keys.emplace_back("at_contact", value_text(*value.at_contact));
  return table_text(keys);
}
std::string value_text(const RestCriterion& value) {
  Keys keys;
  if (value.kinetic) keys.emplace_back("kinetic", value_text(*value.kinetic));
  if (value.displacement) keys.emplace_back("displacement", value_text(*value.displacement));
  return table_text(keys);
}
std::string value_text(const Skips& value) {
  Keys keys;
  Skips skips = value;
  describe(skips, [&](const Key& key, bool skip) { keys.emplace_back(key.name, value_text(skip)); });
  return table_text(keys);
}
std::string value_text(const Vec2& value) {
  return array_text(value);
}
std::string value_text(const Vec3& value) {
  return array_text(value);
}
std::string value_text(const Location& value) {
  return value.point ? value_text(*value.point) : "\"centroid\"";
}
std::string value_text(const std::vector<int>& value) {
  return array_text(value);
}
std::string value_text(const History& value) {
  if (value.columns == 3) return array_text(value.entries);
  std::vector<Vec2> entries;
  for (const Vec3& entry : value.entries) entries.emplace_back(entry.head<2>());
  return array_text(entries);
}
std::string value_text(const std::vector<std::string>& value) {
  return array_text(value);
}
std::string value_text(const std::array<Reference, 2>& value) {
  return array_text(value);
}
std::string value_text(const BlockList& value) {
  return array_text(value.blocks);
}

std::string value_text(const Reference& value) {
  return value.index ? std::to_string(*value.index) : quoted(value.name);
}

std::string value_text(const FixedVertices& value) {
  if (value.all) return "true";
  return value.some.empty() ? "false" : value_text(value.some);
}

std::string value_text(const std::vector<JointChange>& value) {
  Keys joints;
  for (const JointChange& change : value) {
    Keys law;
    describe_change(change, [&](const Key& key, const auto& of_law) {
      if (of_law) law.emplace_back(key.name, value_text(*of_law));
    });
    joints.emplace_back(
        key_text(change.joint.index ? std::to_string(*change.joint.index) : change.joint.name),
        table_text(law));
  }
  return table_text(joints);
}

std::string value_text(const Outline& value) {
  std::string text = "[";
  for (polyfem::Index k = 0; k < value.points.cols(); ++k)
    text += (k > 0 ? ", " : "") + value_text(Vec2(value.points.col(k)));
  return text + ']';
}

std::string value_text(const EdgeJoints& value) {
  return array_text(value.joints);
}
std::string value_text(const Boundary& value) {
  return value.file.empty() ? value_text(value.outline) : value_text(value.file);
}
std::string value_text(const GroupNames& value) {
  return array_text(value);
}
std::string value_text(const GridRecord& value) {
  return table_text({{"count", array_text(value.count)},
                     {"step", value_text(value.step)},
                     {"bond", value_text(value.bond)}});
}
std::string value_text(const InitialStress& value) {
  return table_text({{"level", value_text(value.level)},
                     {"stress", value_text(value.stress)},
                     {"gradient", value_text(value.gradient)}});
}
std::string value_text(const BlockReference& value) {
  return value_text(static_cast<const Reference&>(value));
}
std::string value_text(const VertexSelection& value) {
  return value_text(value.some);
}
std::string value_text(const EdgeSelection& value) {
  return value_text(value.edge);
}
std::string value_text(const LineSegment& value) {
  return array_text(std::array{value.from, value.to});
}
std::string value_text(const Parameters&) {
  return "{}";
}

std::string type_text(GradientCorrection) {
  return "true or false";
}
std::string type_text(bool) {
  return "true or false";
}
std::string type_text(int) {
  return "a whole number";
}
std::string type_text(double) {
  return "a number";
}
std::string type_text(const std::string&) {
  return "a string";
}
std::string type_text(const RayleighDamping&) {
  return "{ mass, stiffness }";
}
std::string type_text(const MeshRecord&) {
  return "{ kind, cells or cell_size, edge_nodes, at_contact }";
}
std::string type_text(const RestCriterion&) {
  return "{ kinetic, displacement }";
}
std::string type_text(const Skips&) {
  return "a table of true or false";
}
std::string type_text(const Vec2&) {
  return "[x, y]";
}
std::string type_text(const Vec3&) {
  return "[xx, yy, xy]";
}
std::string type_text(const Reference&) {
  return "a name or an index";
}
std::string type_text(const Location&) {
  return "[x, y] or \"centroid\"";
}
std::string type_text(const FixedVertices&) {
  return "true, false or a list of vertex indices";
}
std::string type_text(const Outline&) {
  return "[[x, y], ...]";
}
std::string type_text(const std::vector<int>&) {
  return "a list of vertex indices";
}
std::string type_text(const History&) {
  return "[[t, x, y], ...] or the path of a .csv file";
}
std::string type_text(const std::vector<std::string>&) {
  return "a list of " + list_of(field_words());
}
std::string type_text(const std::array<Reference, 2>&) {
  return "two names of materials";
}
std::string type_text(const BlockList&) {
  return "a list of names or indices of blocks, and of selectors";
}
std::string type_text(const GroupNames&) {
  return "a name or a list of names";
}
std::string type_text(const GridRecord&) {
  return "{ count = [n, m], step = [x, y], bond }";
}
std::string type_text(const InitialStress&) {
  return "{ level, stress, gradient }";
}
std::string type_text(const BlockReference&) {
  return "a name, an index or a selector";
}
std::string type_text(const VertexSelection&) {
  return "a list of vertex indices or a selector";
}
std::string type_text(const EdgeSelection&) {
  return "an index or a selector";
}
std::string type_text(const LineSegment&) {
  return "[[x, y], [x, y]]";
}
std::string type_text(const Parameters&) {
  return "{ NAME = a number, ... }";
}
std::string type_text(const EdgeJoints&) {
  return "a list of names or indices of joints, one for each edge";
}
std::string type_text(const Boundary&) {
  return "[[x, y], ...] or the path of a drawing";
}
std::string type_text(const JointChange&) {
  std::string keys;
  const JointChange change;
  describe_change(change, [&](const Key& key, const auto&) {
    keys += (keys.empty() ? "" : ", ") + std::string(key.name);
  });
  return "{ " + keys + " }";
}
std::string type_text(const std::vector<JointChange>&) {
  return "{ JOINT = " + type_text(JointChange{}) + ", ... }";
}

}  // namespace ddacontact::scene_format
