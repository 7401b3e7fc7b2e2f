#include <ddacontact/scene/document_reader.hpp>
#include <ddacontact/scene/schema.hpp>
#include <ddacontact/scene/table_reader.hpp>

namespace ddacontact::scene_format {

namespace {

class DocumentReader : public TableReader {
 public:
  using TableReader::TableReader;

  template <class Record>
  void table(const Key& key, Record& record) {
    const std::string title = "[" + std::string(key.name) + "]";
    const toml::node* node = find(key);
    if (!node) {
      if (key.required) missing_table<Record>(key.name, title);
      return;
    }
    if (!node->is_table()) {
      problems_.error(location_of(*node, problems_),
                      "'" + std::string(key.name) + "' is " + description_of(*node),
                      "write one table " + title);
      return;
    }
    read_table(*node->as_table(), title, record);
  }

  template <class Record>
  void table(const Key& key, std::optional<Record>& record) {
    if (!table_.get(key.name)) return static_cast<void>(find(key));
    const std::size_t n_faults = problems_.n_faults();
    table(key, record.emplace());
    locations_.add(key.name, record->locations.table, problems_.n_faults() == n_faults);
  }

  template <class Record>
  void tables(const Key& key, std::vector<Record>& records) {
    const std::string title = "[[" + std::string(key.name) + "]]";
    const toml::node* node = find(key);
    const toml::array* array = node ? node->as_array() : nullptr;
    if (node && !array) {
      problems_.error(location_of(*node, problems_),
                      "'" + std::string(key.name) + "' is " + description_of(*node),
                      "write " + title + " for each");
      return;
    }
    if (!array || array->empty()) {
      if (key.required) missing_table<Record>(key.name, title);
      return;
    }
    records.reserve(array->size());
    for (const toml::node& element : *array) {
      records.emplace_back();
      if (const toml::table* table = element.as_table())
        read_table(*table, title, records.back());
      else
        problems_.error(location_of(element, problems_),
                        "an element of '" + std::string(key.name) + "' is " + description_of(element),
                        "write " + title + " for each");
    }
  }
  using TableReader::operator();

 private:
  template <class Record>
  void missing_table(const std::string& name, const std::string& title) {
    Record record;
    std::string keys;
    describe(record, [&](const Key& key, const auto&) {
      if (key.required) keys += (keys.empty() ? "'" : ", '") + std::string(key.name) + "'";
    });
    const std::string expected = title + " with " + keys;
    missing_.push_back({name, expected, "the scene has no " + title, "add " + expected});
  }

  template <class Record>
  void read_table(const toml::table& source, std::string_view title, Record& record) {
    record.locations.table = location_of(source, problems_);
    TableReader reader(source, title, record.locations, problems_);
    describe(record, reader);
    reader.refuse_other_keys();
  }
};

}  // namespace

Document read_document(const toml::table& root, ProblemList& problems) {
  Document document;
  const toml::array* stages = root["stage"].as_array();
  document.analysis.in_stages = stages && !stages->empty();
  DocumentReader reader(root, "the scene", document.locations, problems);
  describe(document, reader);
  reader.refuse_other_keys();
  return document;
}

}  // namespace ddacontact::scene_format
