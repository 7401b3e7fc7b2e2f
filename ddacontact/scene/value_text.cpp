#include <ddacontact/scene/text.hpp>
#include <ddacontact/scene/value_text.hpp>

namespace ddacontact::scene_format {

namespace {

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
  return "{ mass = " + value_text(value.mass) + ", stiffness = " + value_text(value.stiffness) + " }";
}
std::string value_text(const MeshRecord& value) {
  std::string text;
  const auto add = [&](const char* key, const std::string& of_key) {
    text += std::string(text.empty() ? "{ " : ", ") + key + " = " + of_key;
  };
  if (value.kind) add("kind", value_text(*value.kind));
  if (value.cells) add("cells", value_text(*value.cells));
  if (value.cell_size) add("cell_size", value_text(*value.cell_size));
  if (value.edge_nodes) add("edge_nodes", *value.edge_nodes ? "true" : "false");
  return text.empty() ? "{}" : text + " }";
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
std::string value_text(const std::vector<Vec3>& value) {
  return array_text(value);
}
std::string value_text(const std::vector<std::string>& value) {
  return array_text(value);
}
std::string value_text(const std::vector<Reference>& value) {
  return array_text(value);
}

std::string value_text(const Reference& value) {
  return value.index ? std::to_string(*value.index) : quoted(value.name);
}

std::string value_text(const FixedVertices& value) {
  if (value.all) return "true";
  return value.some.empty() ? "false" : value_text(value.some);
}

std::string value_text(const Outline& value) {
  std::string text = "[";
  for (polyfem::Index k = 0; k < value.points.cols(); ++k)
    text += (k > 0 ? ", " : "") + value_text(Vec2(value.points.col(k)));
  return text + ']';
}

std::string type_text(GradientCorrection) {
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
  return "{ kind, cells or cell_size, edge_nodes }";
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
std::string type_text(const std::vector<Vec3>&) {
  return "[[t, x, y], ...]";
}
std::string type_text(const std::vector<std::string>&) {
  return "a list of " + list_of(field_words());
}
std::string type_text(const std::vector<Reference>&) {
  return "two names of materials";
}

}  // namespace ddacontact::scene_format
