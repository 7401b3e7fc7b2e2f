#include <ddacontact/scene/parameters.hpp>
#include <ddacontact/scene/spelling.hpp>
#include <ddacontact/scene/text.hpp>
#include <ddacontact/scene/toml_value.hpp>
#include <ddacontact/scene/units.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ddacontact::scene_format {

namespace {

constexpr Bounds number_of_cells{.low = 1, .high = most_cells};

}  // namespace

std::string ValueReader::element_name(int row, int column) const {
  std::string name = key_.name;
  if (row >= 0) name += '[' + std::to_string(row) + ']';
  if (column >= 0) name += '[' + std::to_string(column) + ']';
  return name;
}

bool ValueReader::wrong_type(const toml::node& node, const std::string& name,
                             const std::string& expected) const {
  if (is_unknown_parameter(node))
    problems_.note_missing_value();
  else
    problems_.error(location_of(node, problems_), "'" + name + "' is " + description_of(node),
                    "expected " + expected);
  return false;
}

bool ValueReader::unknown_word(const toml::node& node, const std::vector<std::string_view>& known) const {
  const std::string& word = node.as_string()->get();
  if (is_unknown_parameter(node)) return wrong_type(node, key_.name, "");
  problems_.error(location_of(node, problems_),
                  "'" + std::string(key_.name) + "' = '" + excerpt(word) + "' is not known",
                  suggestion(word, "word", known));
  return false;
}

bool ValueReader::read_number(const toml::node& node, const Key& key, double& value, int row,
                              int column) const {
  if (is_unknown_parameter(node)) return wrong_type(node, key.name, "");
  QuantityReading reading;
  if (const auto* real = node.as_floating_point())
    reading.value = real->get();
  else if (const auto* whole = node.as_integer())
    reading.value = static_cast<double>(whole->get());
  else if (const auto* parameter = node.as_string(); parameter && is_parameter(parameter->get()))
    reading = read_parameter(parameter->get(), key.unit, key.other_unit);
  else if (const auto* text = node.as_string(); text && *key.unit != '\0')
    reading = read_quantity(text->get(), key.unit, key.other_unit);
  else
    return wrong_type(node, element_name(row, column), expected_text(key, 0.0));

  if (reading.error.empty()) {
    if (!std::isfinite(reading.value))
      reading.error = "is not a finite number";
    else if (std::abs(reading.value) > largest_number)
      reading.error = "is too large";
    else if (!key.bounds.contain(reading.value))
      reading.error = "is out of range";
    else if (key.bounds.low == 0 && !key.bounds.with_low && reading.value < smallest_positive)
      reading.error = "is too small";
  }
  if (!reading.error.empty()) {
    std::string cure = "expected " + expected_text(key, 0.0);
    if (*key.unit != '\0') cure += ", or a string with its unit such as \"1 " + std::string(key.unit) + '"';
    problems_.error(location_of(node, problems_),
                    "'" + element_name(row, column) + "' = '" + literal_of(node) + "' " + reading.error,
                    cure);
    return false;
  }
  value = reading.value;
  return true;
}

bool ValueReader::read_numbers(const toml::node& node, double* values, std::size_t size,
                               const std::string& expected, int row) const {
  const toml::array* array = node.as_array();
  if (!array || array->size() != size) return wrong_type(node, element_name(row, -1), expected);
  bool good = true;
  for (int i = 0; i < static_cast<int>(size); ++i)
    if (!read_number((*array)[i], key_, values[i], row >= 0 ? row : i, row >= 0 ? i : -1)) good = false;
  return good;
}

bool ValueReader::operator()(const toml::node& node, GradientCorrection& value) const {
  const auto* flag = node.as_boolean();
  if (!flag) return wrong_type(node, key_.name, expected_text(key_, value));
  value = flag->get() ? GradientCorrection::on : GradientCorrection::off;
  return true;
}

bool ValueReader::operator()(const toml::node& node, bool& value) const {
  const auto* flag = node.as_boolean();
  if (!flag) return wrong_type(node, key_.name, expected_text(key_, value));
  value = flag->get();
  return true;
}

bool ValueReader::operator()(const toml::node& node, int& value) const {
  const std::optional<std::int64_t> whole = whole_number(node);
  if (!whole) return wrong_type(node, key_.name, expected_text(key_, value));
  const std::int64_t number = *whole;
  const bool fits = number <= std::numeric_limits<int>::max() && number >= std::numeric_limits<int>::min();
  if (!fits || !key_.bounds.contain(static_cast<double>(number))) {
    problems_.error(location_of(node, problems_),
                    "'" + std::string(key_.name) + "' = '" + std::to_string(number) + "' is " +
                        (fits ? "out of range" : "too large"),
                    "expected " + expected_text(key_, value));
    return false;
  }
  value = static_cast<int>(number);
  return true;
}

bool ValueReader::operator()(const toml::node& node, double& value) const {
  return read_number(node, key_, value);
}

bool ValueReader::operator()(const toml::node& node, std::string& value) const {
  const auto* text = node.as_string();
  if (!text) return wrong_type(node, key_.name, "a string in quotes");
  value = text->get();
  return true;
}

bool ValueReader::operator()(const toml::node& node, RayleighDamping& value) const {
  const toml::table* table = node.as_table();
  if (!table) return wrong_type(node, key_.name, expected_text(key_, value));
  Key mass = key_, stiffness = key_;
  mass.name = "damping.mass";
  mass.unit = "1/s";
  stiffness.name = "damping.stiffness";
  stiffness.unit = "s";
  bool good = true;
  for (const auto& [name, part] : *table) {
    if (name == "mass") {
      good &= ValueReader(mass, problems_)(part, value.mass);
    } else if (name == "stiffness") {
      good &= ValueReader(stiffness, problems_)(part, value.stiffness);
    } else {
      problems_.error(location_of(name, problems_), "unknown key '" + excerpt(name.str()) + "' in 'damping'",
                      suggestion(name.str(), "key", {"mass", "stiffness"}));
      good = false;
    }
  }
  return good;
}

bool ValueReader::operator()(const toml::node& node, MeshRecord& value) const {
  const toml::table* table = node.as_table();
  if (!table) return wrong_type(node, key_.name, expected_text(key_, value));
  const auto read = [&](const Key& key, const toml::node& part, const char* name, auto& target) {
    target.emplace();
    const bool good = ValueReader(key, problems_)(part, *target);
    value.locations.add(name, location_of(part, problems_), good);
    return good;
  };
  bool good = true;
  for (const auto& [name, part] : *table) {
    if (name == "kind") {
      good &= read({.name = "mesh.kind", .what = ""}, part, "kind", value.kind);
    } else if (name == "cells") {
      good &= read({.name = "mesh.cells", .what = "", .bounds = number_of_cells}, part, "cells", value.cells);
    } else if (name == "cell_size") {
      good &= read({.name = "mesh.cell_size", .what = "", .unit = "m", .bounds = positive}, part, "cell_size",
                   value.cell_size);
    } else if (name == "at_contact") {
      good &= read({.name = "mesh.at_contact", .what = "", .unit = "m", .bounds = positive}, part,
                   "at_contact", value.at_contact);
    } else if (name == "edge_nodes") {
      const auto* flag = part.as_boolean();
      if (flag)
        value.edge_nodes = flag->get();
      else
        good = wrong_type(part, "mesh.edge_nodes", "true or false");
    } else {
      problems_.error(
          location_of(name, problems_), "unknown key '" + excerpt(name.str()) + "' in 'mesh'",
          suggestion(name.str(), "key", {"kind", "cells", "cell_size", "edge_nodes", "at_contact"}));
      good = false;
    }
  }
  if (!value.cells || !value.cell_size) return good;
  const SourceLocation &cells = value.locations.of("cells"), &size = value.locations.of("cell_size");
  problems_.error(cells.source ? cells : size, "both 'cells' and 'cell_size' are given in 'mesh'",
                  "leave one of them out");
  return false;
}

bool ValueReader::operator()(const toml::node& node, RestCriterion& value) const {
  const toml::table* table = node.as_table();
  if (!table) return wrong_type(node, key_.name, expected_text(key_, value));
  Key kinetic = key_, displacement = key_;
  kinetic.name = "until.kinetic";
  displacement.name = "until.displacement";
  bool good = true;
  for (const auto& [name, part] : *table) {
    if (name == "kinetic") {
      good &= ValueReader(kinetic, problems_)(part, value.kinetic.emplace());
    } else if (name == "displacement") {
      good &= ValueReader(displacement, problems_)(part, value.displacement.emplace());
    } else {
      problems_.error(location_of(name, problems_), "unknown key '" + excerpt(name.str()) + "' in 'until'",
                      suggestion(name.str(), "key", {"kinetic", "displacement"}));
      good = false;
    }
  }
  if (!table->empty()) return good;
  problems_.error(location_of(node, problems_), "'until' says nothing of when the stage ends",
                  "write until = { kinetic = 1e-8, displacement = 1e-6 }, or one of the two");
  return false;
}

bool ValueReader::operator()(const toml::node& node, Vec2& value) const {
  return read_numbers(node, value.data(), 2, expected_text(key_, value));
}

bool ValueReader::operator()(const toml::node& node, Vec3& value) const {
  return read_numbers(node, value.data(), 3, expected_text(key_, value));
}

bool ValueReader::operator()(const toml::node& node, Reference& value) const {
  if (const auto* text = node.as_string()) {
    value.name = text->get();
  } else if (const auto* whole = node.as_integer()) {
    value.index = whole->get();
  } else {
    return wrong_type(node, key_.name, expected_text(key_, value));
  }
  return true;
}

bool ValueReader::operator()(const toml::node& node, Location& value) const {
  if (const auto* text = node.as_string()) {
    if (text->get() != "centroid") return unknown_word(node, {"centroid"});
    value.point.reset();
    return true;
  }
  Vec2 point;
  if (!read_numbers(node, point.data(), 2, expected_text(key_, value))) return false;
  value.point = point;
  return true;
}

bool ValueReader::operator()(const toml::node& node, FixedVertices& value) const {
  if (const auto* flag = node.as_boolean()) {
    value.all = flag->get();
    return true;
  }
  if (!node.is_array()) return wrong_type(node, key_.name, expected_text(key_, value));
  return (*this)(node, value.some);
}

bool ValueReader::operator()(const toml::node& node, Outline& value) const {
  const toml::array* array = node.as_array();
  if (!array) return wrong_type(node, key_.name, expected_text(key_, value));
  const int size = static_cast<int>(array->size());
  if (size > 0 && std::ranges::all_of(*array, [](const toml::node& of) { return of.is_number(); })) {
    problems_.error(location_of(node, problems_), "'" + std::string(key_.name) + "' is a list of numbers",
                    "write pairs, [[x, y], [x, y], ...] in m");
    return false;
  }
  value.points.resize(2, size);
  value.locations.reserve(array->size());
  bool good = true;
  for (int k = 0; k < size; ++k) {
    Vec2 point;
    if (!read_numbers((*array)[k], point.data(), 2, "[x, y] in m", k))
      good = false;
    else
      value.points.col(k) = point;
    value.locations.push_back(location_of((*array)[k], problems_));
  }
  return good;
}

bool ValueReader::operator()(const toml::node& node, std::vector<int>& value) const {
  const toml::array* array = node.as_array();
  if (!array) return wrong_type(node, key_.name, expected_text(key_, value));
  bool good = true;
  for (const toml::node& element : *array) {
    const std::int64_t index = whole_number(element).value_or(-1);
    if (index < 0 || index > std::numeric_limits<int>::max()) {
      good = wrong_type(element, element_name(static_cast<int>(value.size()), -1),
                        "the index of a vertex, from 0");
      value.push_back(0);
    } else {
      value.push_back(static_cast<int>(index));
    }
  }
  return good;
}

bool ValueReader::read_path(const toml::node& node, std::string& value, const char* other) const {
  if (!(*this)(node, value)) return false;
  if (!value.empty()) return true;
  problems_.error(location_of(node, problems_), "'" + std::string(key_.name) + "' = '' names no file",
                  "write the path of a file, or " + std::string(other));
  return false;
}

bool ValueReader::operator()(const toml::node& node, History& value) const {
  value.unit = key_.unit;
  value.other_unit = key_.other_unit;
  if (node.is_string()) return read_path(node, value.file, "a table of entries");
  const toml::array* array = node.as_array();
  if (!array || array->empty()) return wrong_type(node, key_.name, expected_text(key_, value));
  Key time = key_;
  time.unit = "s";
  time.other_unit = "";
  const toml::array* first = array->front().as_array();
  value.columns = first && first->size() == 2 ? 2 : 3;
  bool good = true;
  for (int i = 0; i < static_cast<int>(array->size()); ++i) {
    const toml::array* row = (*array)[i].as_array();
    if (!row || static_cast<int>(row->size()) != value.columns) {
      good = wrong_type(
          (*array)[i], element_name(i, -1),
          (value.columns == 2 ? "[t, value] in s and " : "[t, x, y] in s and ") + std::string(key_.unit));
      continue;
    }
    Vec3 entry = Vec3::Zero();
    for (int k = 0; k < value.columns; ++k)
      if (!read_number((*row)[k], k == 0 ? time : key_, entry[k], i, k)) good = false;
    if (good && !value.entries.empty() && !(value.entries.back()[0] < entry[0])) {
      problems_.error(location_of((*row)[0], problems_),
                      "'" + element_name(i, 0) + "' = '" + short_number(entry[0]) +
                          "' is not later than the entry before",
                      "times must increase");
      good = false;
    }
    value.entries.push_back(entry);
  }
  return good;
}

bool ValueReader::operator()(const toml::node& node, std::vector<std::string>& value) const {
  const toml::array* array = node.as_array();
  if (!array) return wrong_type(node, key_.name, expected_text(key_, value));
  value.clear();
  bool good = true;
  for (const toml::node& element : *array) {
    std::string word;
    if (read_word(element, field_words(), word))
      value.push_back(std::move(word));
    else
      good = false;
  }
  return good;
}

bool ValueReader::operator()(const toml::node& node, std::array<Reference, 2>& value) const {
  const toml::array* array = node.as_array();
  if (!array || array->size() != 2) return wrong_type(node, key_.name, expected_text(key_, value));
  const bool first = (*this)((*array)[0], value[0]);
  return (*this)((*array)[1], value[1]) && first;
}

bool ValueReader::operator()(const toml::node& node, BlockList& value) const {
  const toml::array* array = node.as_array();
  if (!array) return wrong_type(node, key_.name, expected_text(key_, value));
  bool good = true;
  for (const toml::node& element : *array) {
    BlockReference block;
    if ((*this)(element, block)) {
      value.blocks.push_back(std::move(block));
      value.locations.push_back(location_of(element, problems_));
    } else {
      good = false;
    }
  }
  return good;
}

bool ValueReader::operator()(const toml::node& node, EdgeJoints& value) const {
  const toml::array* array = node.as_array();
  if (!array) return wrong_type(node, key_.name, expected_text(key_, value));
  bool good = true;
  for (const toml::node& element : *array) good = (*this)(element, value.joints.emplace_back()) && good;
  return good;
}

bool ValueReader::operator()(const toml::node& node, Boundary& value) const {
  if (node.is_string()) return read_path(node, value.file, "vertices");
  return node.is_array() ? (*this)(node, value.outline)
                         : wrong_type(node, key_.name, expected_text(key_, value));
}

}  // namespace ddacontact::scene_format
