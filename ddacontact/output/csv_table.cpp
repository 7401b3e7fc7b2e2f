#include <ddacontact/output/csv_table.hpp>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>

namespace ddacontact {

namespace {

/// The rows of a text, those without anything left out; a quoted cell may hold commas, line ends and doubled
/// quotes. Spreadsheets begin a text by a byte order mark.
std::vector<std::vector<std::string>> parsed(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> row(1);
  bool quoted = false;
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  for (std::size_t i = text.starts_with(mark) ? mark.size() : 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c != '"')
        row.back() += c;
      else if (i + 1 < text.size() && text[i + 1] == '"')
        row.back() += text[++i];
      else
        quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',') {
      row.emplace_back();
    } else if (c == '\n') {
      if (row.size() > 1 || !row[0].empty()) rows.push_back(std::move(row));
      row.assign(1, {});
    } else if (c != '\r') {
      row.back() += c;
    }
  }
  if (row.size() > 1 || !row[0].empty()) rows.push_back(std::move(row));
  return rows;
}

}  // namespace

CsvTable::CsvTable(const std::filesystem::path& path) : path_(path.string()) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw Error("cannot read \"" + path_ + "\"");
  rows_ = parsed(text.str());
  if (rows_.empty()) throw Error("\"" + path_ + "\" is empty");
  header_ = std::move(rows_.front());
  rows_.erase(rows_.begin());
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (rows_[i].size() != header_.size())
      throw Error("\"" + path_ + "\" is damaged: row " + std::to_string(i + 1) + " has " +
                  std::to_string(rows_[i].size()) + " cells, the header " + std::to_string(header_.size()));
}

std::size_t CsvTable::index_of(std::string_view column) const {
  const auto found = std::find(header_.begin(), header_.end(), column);
  if (found == header_.end()) throw Error("\"" + path_ + "\" has no column \"" + std::string(column) + "\"");
  return static_cast<std::size_t>(found - header_.begin());
}

std::vector<std::string> CsvTable::texts(std::string_view column) const {
  const std::size_t index = index_of(column);
  std::vector<std::string> cells;
  for (const std::vector<std::string>& row : rows_) cells.push_back(row[index]);
  return cells;
}

std::vector<double> CsvTable::numbers(std::string_view column) const {
  const std::size_t index = index_of(column);
  std::vector<double> values;
  for (const std::vector<std::string>& row : rows_) {
    const std::string& cell = row[index];
    double value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size() || cell.empty())
      throw Error("\"" + path_ + "\" is damaged: \"" + cell + "\" in column \"" + std::string(column) +
                  "\", row " + std::to_string(values.size() + 1) + ", is no number");
    values.push_back(value);
  }
  return values;
}

}  // namespace ddacontact
