#include <ddacontact/scene/catalog.hpp>
#include <ddacontact/scene/schema.hpp>

namespace ddacontact::scene_format {

namespace {

struct Collector {
  std::vector<CatalogEntry> entries;

  template <class T>
  void operator()(const Key& key, const T&) {
    entries.push_back({key.name, CatalogEntry::Kind::key, {}});
  }
  template <class Record>
  void table(const Key& key, Record& record, CatalogEntry::Kind kind = CatalogEntry::Kind::table) {
    CatalogEntry& entry = entries.emplace_back(CatalogEntry{key.name, kind, {}});
    describe(record, [&](const Key& inner, const auto&) { entry.keys.emplace_back(inner.name); });
  }
  template <class Record>
  void table(const Key& key, std::optional<Record>&) {
    Record record;
    table(key, record);
  }
  template <class Record>
  void tables(const Key& key, std::vector<Record>&) {
    Record record;
    table(key, record, CatalogEntry::Kind::tables);
  }
};

}  // namespace

const std::vector<CatalogEntry>& catalog() {
  static const std::vector<CatalogEntry> entries = [] {
    Document document;
    Collector collector;
    describe(document, collector);
    return collector.entries;
  }();
  return entries;
}

}  // namespace ddacontact::scene_format
