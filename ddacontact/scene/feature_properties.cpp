#include <ddacontact/scene/feature_properties.hpp>
#include <ddacontact/scene/spelling.hpp>
#include <ddacontact/scene/value_text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace ddacontact::scene_format {

namespace {

constexpr std::array<const char*, 5> keys{"name", "material", "model", "fixed", "group"};
constexpr std::array<std::string_view, 5> keys_of_tables{"vertices", "mesh", "velocity", "angular_velocity",
                                                         "stress"};

/// A number that counts something from 0.
std::optional<int> index_of(const JsonValue& value) {
  if (!value.is(JsonKind::number)) return std::nullopt;
  const double number = value.number();
  if (!(number >= 0) || number > std::numeric_limits<int>::max() || number != std::floor(number))
    return std::nullopt;
  return static_cast<int>(number);
}

/// One property of one feature.
class PropertyReader {
 public:
  PropertyReader(const JsonMember& property, const std::string& title, ProblemList& problems)
      : property_(property), value_(property.value), title_(title), problems_(problems) {}

  bool operator()(std::optional<std::string>& name) const {
    if (!value_.is(JsonKind::string)) return wrong_type(value_, type_text(std::string()));
    name = value_.text();
    return true;
  }

  bool operator()(Reference& material) const {
    const std::optional<int> index = index_of(value_);
    if (!index && !value_.is(JsonKind::string)) return wrong_type(value_, type_text(material));
    material = index ? Reference{"", *index} : Reference{value_.text(), std::nullopt};
    return true;
  }

  bool operator()(std::optional<BlockModel>& model) const {
    const auto& words = words_of(BlockModel{});
    if (!value_.is(JsonKind::string)) return wrong_type(value_, list_of(words));
    const std::string& text = value_.text();
    std::vector<std::string_view> known;
    for (const Word<BlockModel>& word : words) {
      if (text == word.text) model = word.choice;
      known.emplace_back(word.text);
    }
    return model || refuse(" is not known", suggestion(text, "word", known));
  }

  bool operator()(FixedVertices& fixed) const {
    if (value_.is(JsonKind::boolean)) {
      fixed.all = value_.number() != 0;
      return true;
    }
    if (!value_.is(JsonKind::array)) return wrong_type(value_, type_text(fixed));
    for (const JsonValue& element : value_.elements()) {
      const std::optional<int> index = index_of(element);
      if (!index) return wrong_type(element, "the index of a vertex, from 0");
      fixed.some.push_back(*index);
    }
    return true;
  }

  bool operator()(GroupNames& groups) const {
    if (value_.is(JsonKind::string)) {
      groups = {value_.text()};
      return true;
    }
    if (!value_.is(JsonKind::array)) return wrong_type(value_, type_text(groups));
    for (const JsonValue& element : value_.elements()) {
      if (!element.is(JsonKind::string)) return wrong_type(element, "the name of a group");
      groups.push_back(element.text());
    }
    return true;
  }

 private:
  /// Of a word.
  bool refuse(const std::string& what, const std::string& cure) const {
    problems_.error(value_.location(),
                    "'" + property_.key + "' = '" + excerpt(value_.text()) + "' of " + title_ + what, cure);
    return false;
  }
  bool wrong_type(const JsonValue& value, const std::string& expected) const {
    problems_.error(value.location(),
                    "'" + property_.key + "' of " + title_ + (&value == &value_ ? " is " : " holds ") +
                        value.description(),
                    "expected " + expected);
    return false;
  }

  const JsonMember& property_;
  const JsonValue& value_;
  const std::string& title_;
  ProblemList& problems_;
};

}  // namespace

void FeatureProperties::read(const JsonMember& property, const std::string& title, BlockRecord& record) {
  const auto key = std::find(keys.begin(), keys.end(), property.key);
  if (key == keys.end()) return warn_of(property, title);
  // Exports write null where a feature has no value.
  if (property.value.is(JsonKind::null)) return;
  const PropertyReader reader(property, title, problems_);
  bool good = false;
  switch (key - keys.begin()) {
    case 0:
      good = reader(record.name);
      break;
    case 1:
      good = reader(record.material);
      break;
    case 2:
      good = reader(record.model);
      break;
    case 3:
      good = reader(record.fixed);
      break;
    default:
      good = reader(record.groups);
  }
  record.locations.add(*key, property.value.location(), good);
}

void FeatureProperties::warn_of(const JsonMember& member, const std::string& title) {
  if (member.value.is(JsonKind::null) || !judged_.insert(member.key).second) return;
  const std::string what = "the property '" + excerpt(member.key) + "' of " + title + " is not read";
  if (std::find(keys_of_tables.begin(), keys_of_tables.end(), member.key) != keys_of_tables.end())
    problems_.warning(member.location, what, "it belongs into a [[block]] of the scene");
  else if (const char* near = keys[nearest(member.key, {keys.begin(), keys.end()})];
           edit_distance(member.key, near) <= 1)
    problems_.warning(member.location, what, "did you mean '" + std::string(near) + "'?");
}

/// Beside 'properties' a member means nothing.
void FeatureProperties::warn_of_outside(const JsonValue& feature, const std::string& title) {
  for (const JsonMember& member : feature.members()) {
    if (std::find(keys.begin(), keys.end(), member.key) == keys.end()) continue;
    if (!judged_outside_.insert(member.key).second) continue;
    problems_.warning(member.location, "'" + member.key + "' of " + title + " is not read",
                      "write it inside 'properties'");
  }
}

void FeatureProperties::refuse_shared(const BlockRecord& record, const std::string& title,
                                      std::size_t n_blocks) {
  const std::string shared = " of " + title + " is for " + std::to_string(n_blocks) + " polygons";
  const std::string cure = "write a feature for each";
  if (record.name && record.locations.good("name"))
    problems_.error(record.locations.of("name"), "'name' = '" + excerpt(*record.name) + "'" + shared, cure);
  if (!record.fixed.some.empty() && record.locations.good("fixed"))
    problems_.error(record.locations.of("fixed"), "the list 'fixed'" + shared, cure);
}

void FeatureProperties::apply(const JsonValue& feature, const std::string& title,
                              std::vector<BlockRecord>& blocks) {
  warn_of_outside(feature, title);
  const std::optional<JsonValue> properties = feature.find("properties");
  if (!properties || properties->is(JsonKind::null)) return;
  if (!properties->is(JsonKind::object))
    return problems_.error(properties->location(),
                           "'properties' of " + title + " is " + properties->description(),
                           "expected an object or null");
  BlockRecord said;
  for (const JsonMember& property : properties->members()) read(property, title, said);
  if (blocks.size() > 1) {
    refuse_shared(said, title, blocks.size());
    said.fixed.some.clear();
  }
  for (BlockRecord& block : blocks) {
    block.name = std::exchange(said.name, std::nullopt);
    if (said.locations.written("material")) block.material = said.material;
    block.model = said.model;
    block.fixed = said.fixed;
    block.groups = said.groups;
    for (const char* key : keys)
      if (said.locations.written(key))
        block.locations.add(key, said.locations.of(key), said.locations.good(key));
  }
}

}  // namespace ddacontact::scene_format
