// Values that select blocks, vertices and edges, and what else stands in inner tables of blocks.
#include <ddacontact/scene/spelling.hpp>
#include <ddacontact/scene/toml_value.hpp>

namespace ddacontact::scene_format {

namespace {

constexpr Bounds number_of_copies{.low = 1, .high = most_copies};

/// The part that is but a point, where no edge can lie; null: there is none.
const char* part_without_length(const PartSelector& selector) {
  if (selector.on && selector.on->from == selector.on->to) return "on";
  if (!selector.box) return nullptr;
  const auto& [x0, y0, x1, y1] = *selector.box;
  return x0 == x1 && y0 == y1 ? "box" : nullptr;
}

}  // namespace

template <class ReadPart>
bool ValueReader::read_parts(const toml::table& table, const std::vector<std::string_view>& known,
                             const ReadPart& read_part) const {
  bool good = true;
  for (const auto& [name, part] : table) {
    if (const std::optional<bool> read = read_part(name.str(), part)) {
      good &= *read;
      continue;
    }
    problems_.error(location_of(name, problems_),
                    "unknown key '" + excerpt(name.str()) + "' in '" + key_.name + "'",
                    suggestion(name.str(), "key", known));
    good = false;
  }
  return good;
}

bool ValueReader::operator()(const toml::node& node, Parameters& value) const {
  return node.is_table() || wrong_type(node, key_.name, type_text(value));
}

bool ValueReader::operator()(const toml::node& node, InitialStress& value) const {
  const toml::table* table = node.as_table();
  if (!table) return wrong_type(node, key_.name, type_text(value));
  const Key level{.name = "initial_stress.level", .what = "", .unit = "m"},
      stress{.name = "initial_stress.stress", .what = "", .unit = "Pa"},
      gradient{.name = "initial_stress.gradient", .what = "", .unit = "N/m3"};
  return read_parts(*table, {"level", "stress", "gradient"},
                    [&](std::string_view name, const toml::node& part) -> std::optional<bool> {
                      if (name == "level") return ValueReader(level, problems_)(part, value.level);
                      if (name == "stress") return ValueReader(stress, problems_)(part, value.stress);
                      if (name == "gradient") return ValueReader(gradient, problems_)(part, value.gradient);
                      return std::nullopt;
                    });
}

bool ValueReader::operator()(const toml::node& node, GroupNames& value) const {
  if (const auto* text = node.as_string()) {
    value = {text->get()};
    return true;
  }
  const toml::array* array = node.as_array();
  if (!array) return wrong_type(node, key_.name, type_text(value));
  bool good = true;
  for (const toml::node& element : *array) {
    if (const auto* text = element.as_string())
      value.push_back(text->get());
    else
      good = wrong_type(element, element_name(static_cast<int>(value.size()), -1), "the name of a group");
  }
  return good;
}

bool ValueReader::operator()(const toml::node& node, GridRecord& value) const {
  const toml::table* table = node.as_table();
  if (!table) return wrong_type(node, key_.name, type_text(value));
  const Key count{.name = "grid.count", .what = "", .bounds = number_of_copies},
      step{.name = "grid.step", .what = "", .unit = "m"}, bond{.name = "grid.bond", .what = ""};
  bool has_all = true;
  for (const char* required : {"count", "step"})
    if (!table->contains(required)) {
      problems_.error(location_of(node, problems_), "missing key '" + std::string(required) + "' in 'grid'",
                      "write 'grid' = { count = [n, m], step = [x, y] }");
      has_all = false;
    }
  return read_parts(*table, {"count", "step", "bond"},
                    [&](std::string_view name, const toml::node& part) -> std::optional<bool> {
                      if (name == "step") return ValueReader(step, problems_)(part, value.step);
                      if (name == "bond") return ValueReader(bond, problems_)(part, value.bond);
                      if (name != "count") return std::nullopt;
                      const toml::array* two = part.as_array();
                      if (!two || two->size() != 2)
                        return wrong_type(part, count.name, "two whole numbers >= 1");
                      const ValueReader read(count, problems_);
                      const bool columns = read((*two)[0], value.count[0]),
                                 rows = read((*two)[1], value.count[1]);
                      return columns && rows;
                    }) &&
         has_all;
}

std::optional<bool> ValueReader::read_place(std::string_view name, const toml::node& part,
                                            Place& value) const {
  const Key metres{.name = key_.name, .what = "", .unit = "m"};
  const ValueReader read(metres, problems_);
  if (name == "at") return read(part, value.at.emplace());
  if (name == "box") return read.read_numbers(part, value.box.emplace().data(), 4, "[x0, y0, x1, y1] in m");
  if (name != "inside") return std::nullopt;
  Outline polygon;
  if (!read(part, polygon)) return false;
  if (polygon.points.cols() < 3) return wrong_type(part, key_.name, "three corners at least");
  value.inside = polygon.points;
  return true;
}

bool ValueReader::require_one_part(const toml::node& node, const std::string& known) const {
  const std::size_t n = node.as_table()->size();
  if (n == 1) return true;
  problems_.error(location_of(node, problems_),
                  "'" + std::string(key_.name) + "' selects by " + std::to_string(n) + " keys",
                  "write one of " + known);
  return false;
}

bool ValueReader::operator()(const toml::node& node, BlockSelector& value) const {
  return read_parts(*node.as_table(), {"group", "inside", "at", "box"},
                    [&](std::string_view name, const toml::node& part) -> std::optional<bool> {
                      if (name == "group") return (*this)(part, value.group.emplace());
                      return read_place(name, part, value);
                    }) &&
         require_one_part(node, "{ group }, { inside }, { at } and { box }");
}

bool ValueReader::operator()(const toml::node& node, PartSelector& value) const {
  return read_parts(*node.as_table(), {"on", "inside", "at", "box"},
                    [&](std::string_view name, const toml::node& part) -> std::optional<bool> {
                      if (name == "on") return (*this)(part, value.on.emplace());
                      return read_place(name, part, value);
                    }) &&
         require_one_part(node, "{ on }, { inside }, { at } and { box }");
}

bool ValueReader::operator()(const toml::node& node, BlockReference& value) const {
  if (node.is_table()) return (*this)(node, value.selector.emplace());
  if (!node.is_string() && !node.is_integer()) return wrong_type(node, key_.name, expected_text(key_, value));
  return (*this)(node, static_cast<Reference&>(value));
}

bool ValueReader::operator()(const toml::node& node, LineSegment& value) const {
  const toml::array* ends = node.as_array();
  if (!ends || ends->size() != 2) return wrong_type(node, key_.name, type_text(value) + " in m");
  const Key metres{.name = key_.name, .what = "", .unit = "m"};
  const ValueReader read(metres, problems_);
  const bool from = read((*ends)[0], value.from), to = read((*ends)[1], value.to);
  return from && to;
}

bool ValueReader::operator()(const toml::node& node, VertexSelection& value) const {
  return node.is_table()   ? (*this)(node, value.selector.emplace())
         : node.is_array() ? (*this)(node, value.some)
                           : wrong_type(node, key_.name, expected_text(key_, value));
}

bool ValueReader::operator()(const toml::node& node, EdgeSelection& value) const {
  if (!node.is_table()) return (*this)(node, value.edge);
  if (!(*this)(node, value.selector.emplace())) return false;
  const char* part = part_without_length(*value.selector);
  if (!part) return true;
  problems_.error(location_of(node, problems_),
                  "'" + std::string(part) + "' of '" + key_.name + "' is a point, on which no edge can lie",
                  "write two points that differ, or { at = [x, y] } for the edges through the point");
  return false;
}

}  // namespace ddacontact::scene_format
