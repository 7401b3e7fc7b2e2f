#include <ddacontact/scene/documentation.hpp>

#include <ddacontact/scene/schema.hpp>
#include <ddacontact/scene/value_text.hpp>

namespace ddacontact::scene_format {

namespace {

/// '|' ends a cell of a Markdown table.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) escaped += c == '|' ? "\\|" : std::string(1, c);
  return escaped;
}

class RowWriter {
 public:
  template <class T>
  void operator()(const Key& key, const T& value) {
    row(key, expected_text(key, value), key.default_text ? key.default_text : '`' + value_text(value) + '`');
  }
  template <class T>
  void operator()(const Key& key, const std::optional<T>&) {
    row(key, expected_text(key, T{}), key.default_text ? key.default_text : "none");
  }
  template <Inner Record>
  void operator()(const Key& key, const std::vector<Record>&) {
    row(key, "tables, see below", "none");
  }
  void operator()(const Key& key, const Skips& skips) {
    Skips defaults = skips;
    describe(defaults, [&](Key inner, bool skip) {
      const std::string name = std::string(key.name) + '.' + inner.name;
      inner.name = name.c_str();
      (*this)(inner, skip);
    });
  }
  void operator()(const Key&, const OfTheWholeRun&) {}
  void operator()(const Key&, const OfStages&) {}

  std::vector<KeyRow> take() && { return std::move(rows_); }

 private:
  void row(const Key& key, const std::string& value, const std::string& default_text) {
    rows_.push_back({key.name, value, key.required ? "required" : default_text, key.what});
  }
  std::vector<KeyRow> rows_;
};

/// Describes one table of those in a table.
struct InnerFinder {
  const std::string& name;
  RowWriter& rows;

  template <class T>
  void operator()(const Key&, const T&) {}
  template <Inner Record>
  void operator()(const Key& key, const std::vector<Record>&) {
    Record record;
    if (name.ends_with('.' + std::string(key.name))) describe(record, rows);
  }
};

/// Describes one table.
struct TableFinder {
  const std::string& name;
  RowWriter rows{};

  template <class T>
  void operator()(const Key& key, const T& value) {
    if (name.empty()) rows(key, value);
  }
  template <class Record>
  void table(const Key& key, Record& record) {
    if (name == key.name) describe(record, rows);
  }
  template <class Record>
  void table(const Key& key, std::optional<Record>&) {
    Record record;
    table(key, record);
    if (name.starts_with(key.name + std::string("."))) describe(record, InnerFinder{name, rows});
  }
  template <class Record>
  void tables(const Key& key, std::vector<Record>&) {
    Record record;
    table(key, record);
  }
};

}  // namespace

std::vector<KeyRow> key_rows(const std::string& table) {
  Document document;
  TableFinder finder{table};
  describe(document, finder);
  return std::move(finder.rows).take();
}

std::string key_table(const std::string& table) {
  std::string text;
  for (const KeyRow& row : key_rows(table))
    text += "| `" + row.name + "` | " + cell(row.value) + " | " + cell(row.default_text) + " | " +
            cell(row.what) + " |\n";
  return text.empty() ? text : "| key | value | default | |\n|---|---|---|---|\n" + text;
}

}  // namespace ddacontact::scene_format
