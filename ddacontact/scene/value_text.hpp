/// \file Values of keys as TOML, and in words what each type of value is.
#pragma once

#include <ddacontact/scene/key.hpp>
#include <ddacontact/scene/words.hpp>

#include <array>
#include <string>
#include <vector>

namespace ddacontact::scene_format {

/// The value as a scene file spells it; reading it gives the same value.
std::string value_text(GradientCorrection value);
std::string value_text(bool value);
std::string value_text(int value);
std::string value_text(double value);
std::string value_text(const std::string& value);
std::string value_text(const RayleighDamping& value);
std::string value_text(const MeshRecord& value);
std::string value_text(const RestCriterion& value);
std::string value_text(const Skips& value);
std::string value_text(const Vec2& value);
std::string value_text(const Vec3& value);
std::string value_text(const Reference& value);
std::string value_text(const Location& value);
std::string value_text(const FixedVertices& value);
std::string value_text(const Outline& value);
std::string value_text(const std::vector<int>& value);
std::string value_text(const History& value);
std::string value_text(const std::vector<std::string>& value);
std::string value_text(const std::array<Reference, 2>& value);
std::string value_text(const BlockList& value);
std::string value_text(const EdgeJoints& value);
std::string value_text(const Boundary& value);
std::string value_text(const std::vector<JointChange>& value);
std::string value_text(const GroupNames& value);
std::string value_text(const GridRecord& value);
std::string value_text(const InitialStress& value);
std::string value_text(const BlockReference& value);
std::string value_text(const VertexSelection& value);
std::string value_text(const EdgeSelection& value);
std::string value_text(const LineSegment& value);
std::string value_text(const Parameters& value);

template <Choice T>
std::string value_text(T value) {
  for (const Word<T>& word : words_of(value))
    if (word.choice == value) return value_text(std::string(word.text));
  return {};
}

/// What a value of that type is: "a whole number", "[x, y]". The value itself plays no part.
std::string type_text(GradientCorrection);
std::string type_text(bool);
std::string type_text(int);
std::string type_text(double);
std::string type_text(const std::string&);
std::string type_text(const RayleighDamping&);
std::string type_text(const MeshRecord&);
std::string type_text(const RestCriterion&);
std::string type_text(const Skips&);
std::string type_text(const Vec2&);
std::string type_text(const Vec3&);
std::string type_text(const Reference&);
std::string type_text(const Location&);
std::string type_text(const FixedVertices&);
std::string type_text(const Outline&);
std::string type_text(const std::vector<int>&);
std::string type_text(const History&);
std::string type_text(const std::vector<std::string>&);
std::string type_text(const std::array<Reference, 2>&);
std::string type_text(const BlockList&);
std::string type_text(const EdgeJoints&);
std::string type_text(const Boundary&);
std::string type_text(const JointChange&);
std::string type_text(const GroupNames&);
std::string type_text(const GridRecord&);
std::string type_text(const InitialStress&);
std::string type_text(const BlockReference&);
std::string type_text(const VertexSelection&);
std::string type_text(const EdgeSelection&);
std::string type_text(const LineSegment&);
std::string type_text(const Parameters&);
std::string type_text(const std::vector<JointChange>&);

/// The words, quoted: `"dynamic" | "static"`.
template <class T>
std::string list_of(const std::vector<Word<T>>& words) {
  std::string list;
  for (const Word<T>& word : words) list += (list.empty() ? "" : " | ") + value_text(std::string(word.text));
  return list;
}

/// "{ a, b }"
template <Inner Record>
std::string type_text(const Record& record) {
  std::string keys;
  Record described = record;
  describe(described,
           [&](const Key& key, const auto&) { keys += (keys.empty() ? "" : ", ") + std::string(key.name); });
  return "{ " + keys + " }";
}

/// The keys that are written.
template <Inner Record>
std::string value_text(const Record& record) {
  std::string keys;
  Record described = record;
  describe(described, [&](const Key& key, const auto& value) {
    if (value) keys += (keys.empty() ? "" : ", ") + std::string(key.name) + " = " + value_text(*value);
  });
  return "{ " + keys + " }";
}

template <Choice T>
std::string type_text(T value) {
  return list_of(words_of(value));
}

/// Type, unit and bounds in one line: "a number in Pa, > 0".
template <class T>
std::string expected_text(const Key& key, const T& value) {
  std::string text = type_text(value);
  if (*key.unit != '\0') text += std::string(" in ") + key.unit;
  if (*key.other_unit != '\0') text += std::string(" or ") + key.other_unit;
  if (const std::string bounds = key.bounds.text(); !bounds.empty()) text += ", " + bounds;
  return text;
}

}  // namespace ddacontact::scene_format
