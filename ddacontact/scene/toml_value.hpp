/// \file Nodes of a TOML tree to the values of keys, with every complaint about them.
#pragma once

#include <ddacontact/scene/key.hpp>
#include <ddacontact/scene/toml_file.hpp>
#include <ddacontact/scene/value_text.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ddacontact::scene_format {

/// Reads the values of one key. Each call returns whether the value is good; if not, `problems` has grown and
/// the value is unchanged or partly read.
class ValueReader {
 public:
  ValueReader(const Key& key, ProblemList& problems) : key_(key), problems_(problems) {}

  bool operator()(const toml::node& node, GradientCorrection& value) const;
  bool operator()(const toml::node& node, bool& value) const;
  bool operator()(const toml::node& node, int& value) const;
  bool operator()(const toml::node& node, double& value) const;
  bool operator()(const toml::node& node, std::string& value) const;
  bool operator()(const toml::node& node, RayleighDamping& value) const;
  bool operator()(const toml::node& node, MeshRecord& value) const;
  bool operator()(const toml::node& node, RestCriterion& value) const;
  bool operator()(const toml::node& node, Vec2& value) const;
  bool operator()(const toml::node& node, Vec3& value) const;
  bool operator()(const toml::node& node, Reference& value) const;
  bool operator()(const toml::node& node, Location& value) const;
  bool operator()(const toml::node& node, FixedVertices& value) const;
  bool operator()(const toml::node& node, Outline& value) const;
  bool operator()(const toml::node& node, std::vector<int>& value) const;
  bool operator()(const toml::node& node, History& value) const;
  bool operator()(const toml::node& node, std::vector<std::string>& value) const;
  bool operator()(const toml::node& node, std::array<Reference, 2>& value) const;
  bool operator()(const toml::node& node, BlockList& value) const;
  bool operator()(const toml::node& node, EdgeJoints& value) const;
  bool operator()(const toml::node& node, Boundary& value) const;
  bool operator()(const toml::node& node, Parameters& value) const;
  bool operator()(const toml::node& node, InitialStress& value) const;
  bool operator()(const toml::node& node, GroupNames& value) const;
  bool operator()(const toml::node& node, GridRecord& value) const;
  bool operator()(const toml::node& node, BlockReference& value) const;
  bool operator()(const toml::node& node, VertexSelection& value) const;
  bool operator()(const toml::node& node, EdgeSelection& value) const;
  bool operator()(const toml::node& node, LineSegment& value) const;

  template <Choice T>
  bool operator()(const toml::node& node, T& value) const {
    return read_word(node, words_of(value), value);
  }

 private:
  template <class T>
  bool read_word(const toml::node& node, const std::vector<Word<T>>& words, T& value) const {
    const auto* text = node.as_string();
    if (!text) return wrong_type(node, key_.name, list_of(words));
    for (const Word<T>& word : words) {
      if (text->get() != word.text) continue;
      value = word.choice;
      return true;
    }
    std::vector<std::string_view> known;
    for (const Word<T>& word : words) known.push_back(word.text);
    return unknown_word(node, known);
  }

  /// A number: of the key itself, or an element of its value called `name`.
  bool read_number(const toml::node& node, const Key& key, double& value, int row = -1,
                   int column = -1) const;
  /// As many numbers as `size`, in the key's unit.
  bool read_numbers(const toml::node& node, double* values, std::size_t size, const std::string& expected,
                    int row = -1) const;
  std::string element_name(int row, int column) const;

  bool operator()(const toml::node& node, BlockSelector& value) const;
  bool operator()(const toml::node& node, PartSelector& value) const;
  /// { inside }, { at } or { box }; nothing for other names.
  std::optional<bool> read_place(std::string_view name, const toml::node& part, Place& value) const;
  /// One of the parts of a selector.
  bool require_one_part(const toml::node& node, const std::string& known) const;
  /// An inner table of this key: read_part(name, node) says whether the value is good, or nothing for a name
  /// that is not among `known`.
  template <class ReadPart>
  bool read_parts(const toml::table& table, const std::vector<std::string_view>& known,
                  const ReadPart& read_part) const;

  /// The path of a file; `other` may stand in its place.
  bool read_path(const toml::node& node, std::string& value, const char* other) const;
  bool wrong_type(const toml::node& node, const std::string& name, const std::string& expected) const;
  bool unknown_word(const toml::node& node, const std::vector<std::string_view>& known) const;

  const Key& key_;
  ProblemList& problems_;
};

}  // namespace ddacontact::scene_format
