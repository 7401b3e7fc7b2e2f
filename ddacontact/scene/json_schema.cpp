#include <ddacontact/scene/json_schema.hpp>

#include <ddacontact/scene/schema.hpp>
#include <ddacontact/scene/value_text.hpp>

#include <nlohmann/json.hpp>

#include <cmath>

namespace ddacontact::scene_format {

namespace {

using Json = nlohmann::ordered_json;

Json types(std::initializer_list<const char*> names) {
  Json list = Json::array();
  for (const char* name : names) list.push_back(name);
  return {{"type", list}};
}

Json list_of_items(const Json& items) {
  return {{"type", "array"}, {"items", items}};
}

Json list_of_items(const Json& items, int length) {
  return {{"type", "array"}, {"items", items}, {"minItems", length}, {"maxItems", length}};
}

/// A number; with its unit, or a parameter's name, it is a string.
Json quantity() {
  return types({"number", "string"});
}

template <class T>
Json of_words(const std::vector<Word<T>>& words) {
  Json list = Json::array();
  for (const Word<T>& word : words) list.push_back(word.text);
  return {{"enum", list}};
}

Json any_of(std::initializer_list<Json> choices) {
  return {{"anyOf", Json(choices)}};
}

/// Of inline tables: these keys and no others.
Json table_of(std::initializer_list<std::pair<const char*, Json>> keys) {
  Json properties = Json::object();
  for (const auto& [name, schema] : keys) properties[name] = schema;
  return {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
}

Json point() {
  return list_of_items(quantity(), 2);
}
Json points() {
  return list_of_items(point());
}

/// What selects by a place, or by `other`: one key of them.
Json selector_of(const char* other, const Json& schema) {
  Json selector = table_of(
      {{other, schema}, {"inside", points()}, {"at", point()}, {"box", list_of_items(quantity(), 4)}});
  selector["minProperties"] = selector["maxProperties"] = 1;
  return selector;
}

Json schema_of(GradientCorrection) {
  return types({"boolean"});
}
Json schema_of(bool) {
  return types({"boolean"});
}
Json schema_of(int) {
  return types({"integer", "string"});
}
Json schema_of(double) {
  return quantity();
}
Json schema_of(const std::string&) {
  return types({"string"});
}
Json schema_of(const Vec2&) {
  return point();
}
Json schema_of(const Vec3&) {
  return list_of_items(quantity(), 3);
}
Json schema_of(const Reference&) {
  return types({"string", "integer"});
}
Json schema_of(const LineSegment&) {
  return list_of_items(point(), 2);
}
Json schema_of(const BlockReference&) {
  return any_of({types({"string", "integer"}), selector_of("group", types({"string"}))});
}
Json schema_of(const EdgeSelection&) {
  return any_of({types({"integer"}), selector_of("on", schema_of(LineSegment()))});
}
Json schema_of(const VertexSelection&) {
  return any_of({list_of_items(types({"integer"})), selector_of("on", schema_of(LineSegment()))});
}
Json schema_of(const Location&) {
  return any_of({point(), {{"const", "centroid"}}});
}
Json schema_of(const FixedVertices&) {
  return any_of({types({"boolean"}), list_of_items(types({"integer"}))});
}
Json schema_of(const Boundary&) {
  return any_of({points(), types({"string"})});
}
Json schema_of(const GroupNames&) {
  return any_of({types({"string"}), list_of_items(types({"string"}))});
}
Json schema_of(const Outline&) {
  return points();
}
Json schema_of(const History&) {
  Json row = list_of_items(quantity());
  row["minItems"] = 2;
  row["maxItems"] = 3;
  return any_of({list_of_items(row), types({"string"})});
}
Json schema_of(const std::vector<std::string>&) {
  return list_of_items(of_words(field_words()));
}
Json schema_of(const std::array<Reference, 2>&) {
  return list_of_items(types({"string", "integer"}), 2);
}
Json schema_of(const BlockList&) {
  return list_of_items(schema_of(BlockReference()));
}
Json schema_of(const EdgeJoints&) {
  return list_of_items(types({"string", "integer"}));
}
Json schema_of(const RayleighDamping&) {
  return table_of({{"mass", quantity()}, {"stiffness", quantity()}});
}
Json schema_of(const RestCriterion&) {
  return table_of({{"kinetic", quantity()}, {"displacement", quantity()}});
}
Json schema_of(const MeshRecord&) {
  return table_of({{"kind", of_words(words_of(CellKind{}))},
                   {"cells", schema_of(0)},
                   {"cell_size", quantity()},
                   {"edge_nodes", types({"boolean"})},
                   {"at_contact", quantity()}});
}
Json schema_of(const GridRecord&) {
  return table_of({{"count", list_of_items(schema_of(0), 2)}, {"step", point()}, {"bond", quantity()}});
}
Json schema_of(const InitialStress&) {
  const Json stress = schema_of(Vec3());
  return table_of({{"level", quantity()}, {"stress", stress}, {"gradient", stress}});
}
Json schema_of(const Parameters&) {
  return {{"type", "object"}, {"additionalProperties", quantity()}};
}
template <Choice T>
Json schema_of(T value) {
  return of_words(words_of(value));
}

/// `minimum` and its like hold for plain numbers; JSON schema has them ignore strings.
void add_bounds(const Bounds& bounds, Json& schema) {
  if (std::isfinite(bounds.low)) schema[bounds.with_low ? "minimum" : "exclusiveMinimum"] = bounds.low;
  if (std::isfinite(bounds.high)) schema[bounds.with_high ? "maximum" : "exclusiveMaximum"] = bounds.high;
}

/// A table a joint, of what may change of its law.
Json schema_of(const std::vector<JointChange>&);

/// Collects the keys of a table.
class ObjectWriter {
 public:
  template <class T>
  void operator()(const Key& key, const T& value) {
    Json schema = schema_of(value);
    if constexpr (std::same_as<T, int> || std::same_as<T, double>) add_bounds(key.bounds, schema);
    add(key, std::move(schema), expected_text(key, value));
  }
  template <class T>
  void operator()(const Key& key, const std::optional<T>&) {
    (*this)(key, T{});
  }
  template <Inner Record>
  void operator()(const Key& key, const Record&) {
    add(key, table_schema<Record>(), "");
  }
  template <Inner Record>
  void operator()(const Key& key, const std::vector<Record>&) {
    add(key, list_of_items(table_schema<Record>()), "");
  }
  void operator()(const Key& key, const Skips& skips) {
    Skips described = skips;
    ObjectWriter inner;
    describe(described, inner);
    add(key, std::move(inner).take(), "");
  }
  void operator()(const Key&, const OfTheWholeRun&) {}
  void operator()(const Key&, const OfStages&) {}
  template <class Record>
  void table(const Key& key, const Record&) {
    add(key, table_schema<Record>(), "");
  }
  template <class Record>
  void table(const Key& key, const std::optional<Record>&) {
    add(key, table_schema<Record>(), "");
  }
  template <class Record>
  void tables(const Key& key, const std::vector<Record>&) {
    add(key, list_of_items(table_schema<Record>()), "");
  }

  Json take() && {
    Json schema = {
        {"type", "object"}, {"properties", std::move(properties_)}, {"additionalProperties", false}};
    if (!required_.empty()) schema["required"] = std::move(required_);
    return schema;
  }

 private:
  template <class Record>
  static Json table_schema() {
    Record record;
    // Whether the number of steps is required depends on [[stage]], which no table sees of another.
    if constexpr (std::same_as<Record, AnalysisRecord>) record.in_stages = true;
    ObjectWriter inner;
    describe(record, inner);
    return std::move(inner).take();
  }
  void add(const Key& key, Json schema, const std::string& value) {
    schema["description"] = key.what + (value.empty() ? "" : " Value: " + value);
    properties_[key.name] = std::move(schema);
    if (key.required) required_.push_back(key.name);
  }

  Json properties_ = Json::object(), required_ = Json::array();
};

Json schema_of(const std::vector<JointChange>&) {
  ObjectWriter change;
  const JointChange law;
  describe_change(law, change);
  return {{"type", "object"}, {"additionalProperties", std::move(change).take()}};
}

}  // namespace

std::string json_schema() {
  Document document;
  document.domain
      .emplace();  // blocks may come from there or from a file: none of the three is required alone
  ObjectWriter writer;
  describe(document, writer);
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                 {"title", "A scene of polydda"}};
  schema.update(std::move(writer).take());
  schema["anyOf"] = Json::array();
  for (const char* source : {"block", "blocks", "domain"})
    schema["anyOf"].push_back({{"required", Json::array({source})}});
  return schema.dump(2) + "\n";
}

}  // namespace ddacontact::scene_format
