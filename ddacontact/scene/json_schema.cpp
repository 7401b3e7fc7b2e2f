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
  return list_of_items(quantity(), 2);
}
Json schema_of(const Vec3&) {
  return list_of_items(quantity(), 3);
}
Json schema_of(const Reference&) {
  return types({"string", "integer"});
}
Json schema_of(const BlockReference&) {
  return types({"string", "integer", "object"});
}
Json schema_of(const EdgeSelection&) {
  return types({"integer", "object"});
}
Json schema_of(const Location&) {
  return types({"array", "string"});
}
Json schema_of(const FixedVertices&) {
  return types({"boolean", "array"});
}
Json schema_of(const Boundary&) {
  return types({"array", "string"});
}
Json schema_of(const GroupNames&) {
  return types({"string", "array"});
}
Json schema_of(const VertexSelection&) {
  return types({"array", "string", "object"});
}
Json schema_of(const Outline&) {
  return list_of_items(list_of_items(quantity(), 2));
}
Json schema_of(const LineSegment&) {
  return list_of_items(list_of_items(quantity(), 2), 2);
}
Json schema_of(const History&) {
  return types({"array", "string"});
}
Json schema_of(const std::vector<std::string>&) {
  return list_of_items(of_words(field_words()));
}
Json schema_of(const std::array<Reference, 2>&) {
  return list_of_items(types({"string", "integer"}), 2);
}
Json schema_of(const BlockList&) {
  return types({"array", "object"});
}
Json schema_of(const EdgeJoints&) {
  return list_of_items(types({"string", "integer"}));
}
template <class T>
requires(std::same_as<T, RayleighDamping> || std::same_as<T, MeshRecord> || std::same_as<T, RestCriterion> ||
         std::same_as<T, GridRecord> || std::same_as<T, InitialStress> || std::same_as<T, Parameters> ||
         std::same_as<T, std::vector<JointChange>>) Json schema_of(const T&) {
  return types({"object"});
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
