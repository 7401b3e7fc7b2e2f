#include <ddacontact/scene/history_file.hpp>

#include <ddacontact/scene/file_text.hpp>
#include <ddacontact/scene/key.hpp>
#include <ddacontact/scene/text.hpp>
#include <ddacontact/scene/units.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

namespace ddacontact::scene_format {

namespace {

constexpr double standard_gravity = 9.80665;  // m/s2

struct Cell {
  std::string_view text;
  int column;  ///< in its line, from 1
};

std::string_view trimmed(std::string_view text) {
  const auto from = text.find_first_not_of(" \t\r\"");
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(" \t\r\"") - from + 1);
}

std::vector<Cell> cells_of(std::string_view line) {
  std::vector<Cell> cells;
  std::size_t at = 0;
  while (true) {
    const std::size_t end = std::min(line.find(',', at), line.size());
    cells.push_back({trimmed(line.substr(at, end - at)), static_cast<int>(at) + 1});
    if (end == line.size()) return cells;
    at = end + 1;
  }
}

/// A column of the file: which number of an entry it is, and one of its unit in SI.
struct Column {
  int component;
  double factor = 1;
};

class HistoryReader {
 public:
  HistoryReader(const std::string& path, History& history, ProblemList& problems)
      : source_(std::make_shared<const std::string>(path)), history_(history), problems_(problems) {}

  void read(std::string_view text) {
    const std::size_t before = problems_.size();
    int number = 0;
    std::size_t at = 0;
    while (at < text.size() && problems_.size() == before) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      const std::string_view line = text.substr(at, end - at);
      at = end + 1;
      ++number;
      if (trimmed(line).empty() || trimmed(line).front() == '#') continue;
      if (columns_.empty())
        read_header(cells_of(line), number);
      else
        read_row(cells_of(line), number);
    }
    if (problems_.size() == before && history_.entries.empty())
      problems_.error({source_, 1, 1}, "the file has no entries",
                      "give it rows of numbers below a header 't,x,y'");
    if (problems_.size() == before) warn_of_missing_rows();
  }

 private:
  /// 1 for x, 2 for y by the end of its name; of a pressure, which has none, 1; else -1.
  int component_of(std::string_view name) const {
    if (history_.columns == 2) return 1;
    const char last = name.empty() ? ' ' : name.back();
    return last == 'x' || last == 'X' ? 1 : last == 'y' || last == 'Y' ? 2 : -1;
  }

  void read_header(const std::vector<Cell>& cells, int line) {
    if (const auto other = cells[0].text.find_first_of(";\t");
        cells.size() == 1 && other != std::string_view::npos)
      return problems_.error(
          {source_, line, 1},
          cells[0].text[other] == ';' ? "';' separates the columns" : "tabs separate the columns",
          "write commas between them, and points in decimal numbers");
    if (cells.size() < 2 || cells.size() > 3)
      return problems_.error({source_, line, 1},
                             "the header has " + std::to_string(cells.size()) + " columns",
                             "write a line 't,x,y' or 't,x' with a unit in brackets where it is not SI");
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const std::string_view text = cells[k].text;
      const std::size_t bracket = text.find_first_of("[(");
      const std::string_view name = trimmed(text.substr(0, bracket));
      if (double number; std::from_chars(text.data(), text.data() + text.size(), number).ec == std::errc())
        return problems_.error({source_, line, cells[k].column}, "the first line has no names of columns",
                               "write a header 't,x,y' with a unit in brackets where it is not SI");
      Column column{k == 0 ? 0 : component_of(name)};
      if (column.component < 0)
        return problems_.error({source_, line, cells[k].column},
                               "column '" + std::string(name) + "' does not say which component it is",
                               "end its name in x or y");
      for (const Column& other : columns_)
        if (other.component == column.component)
          return problems_.error({source_, line, cells[k].column},
                                 history_.columns == 2 ? "a pressure has one column besides the time"
                                                       : "column '" + std::string(name) + "' stands twice",
                                 history_.columns == 2 ? "leave one out" : "give x and y once each");
      if (bracket != std::string_view::npos) {
        const std::string unit(trimmed(text.substr(bracket + 1, text.find_last_of("])") - bracket - 1)));
        const bool gravities = unit == "g" && history_.unit == "m/s2";
        const QuantityReading one = gravities ? QuantityReading{standard_gravity, ""}
                                              : read_quantity("1 " + unit, k == 0 ? "s" : history_.unit,
                                                              k == 0 ? "" : history_.other_unit);
        if (!one.error.empty())
          return problems_.error({source_, line, cells[k].column}, "'" + unit + "' " + one.error,
                                 "expected a unit such as " + (k == 0 ? "s" : history_.unit));
        column.factor = one.value;
      }
      columns_.push_back(column);
    }
  }

  void read_row(const std::vector<Cell>& cells, int line) {
    if (cells.size() != columns_.size())
      return problems_.error({source_, line, 1},
                             "the row has " + std::to_string(cells.size()) + " cells, the header " +
                                 std::to_string(columns_.size()),
                             "give every row as many as the header");
    Vec3 entry = Vec3::Zero();
    for (std::size_t k = 0; k < cells.size(); ++k) {
      double value = 0;
      const std::string_view text = cells[k].text;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
      if (error != std::errc() || end != text.data() + text.size() || !(std::abs(value) < largest_number))
        return problems_.error({source_, line, cells[k].column}, "'" + std::string(text) + "' is no number",
                               "write a finite number; a record may have no gaps");
      entry[columns_[k].component] = columns_[k].factor * value;
    }
    if (!history_.entries.empty() && !(history_.entries.back()[0] < entry[0]))
      return problems_.error(
          {source_, line, 1},
          "the time " + short_number(entry[0]) + " s is not later than that of the row before",
          "times must increase");
    history_.entries.push_back(entry);
    lines_.push_back(line);
  }

  /// A record at even times with a few rows less: what is missing would pass as a straight line.
  void warn_of_missing_rows() {
    constexpr double same = 0.15, of_even = 0.9;  // times may be rounded
    const std::vector<Vec3>& entries = history_.entries;
    std::vector<double> steps;
    for (std::size_t k = 1; k + 1 < entries.size(); ++k)  // the last may close the record
      steps.push_back(entries[k][0] - entries[k - 1][0]);
    if (steps.empty()) return;
    std::vector<double> sorted = steps;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::ranges::nth_element(sorted, middle);
    const double step = *middle;
    const auto is_even = [&](double of) { return std::abs(of - step) <= same * step; };
    const auto is_gap = [&](double of) { return of >= (2 - same) * step; };
    const auto n_even = std::ranges::count_if(steps, is_even), n_gaps = std::ranges::count_if(steps, is_gap);
    if (n_gaps == 0 || static_cast<double>(n_even) < of_even * static_cast<double>(steps.size())) return;
    const std::size_t first = static_cast<std::size_t>(std::ranges::find_if(steps, is_gap) - steps.begin());
    problems_.warning({source_, lines_[first + 1], 1},
                      "rows may be missing: this one comes " + rounded(steps[first]) +
                          " s after the one before, most come after " + rounded(step) + " s" +
                          (n_gaps > 1 ? " (" + std::to_string(n_gaps) + " such gaps in all)" : ""),
                      "add the rows; between two rows the record is a straight line");
  }

  std::shared_ptr<const std::string> source_;
  History& history_;
  ProblemList& problems_;
  std::vector<Column> columns_;
  std::vector<int> lines_;  ///< of the entries
};

}  // namespace

bool read_histories(const std::filesystem::path& directory, Document& document, ProblemList& problems) {
  bool readable = true;
  const auto read = [&](History& history, const char* key, int columns, const KeyLocations& locations) {
    if (history.file.empty() || !locations.good(key)) return;
    const std::string path = (directory / history.file).string();
    const FileText file = read_text(path);
    history.columns = columns;
    if (file.text) return HistoryReader(path, history, problems).read(*file.text);
    readable = false;
    problems.error(locations.of(key),
                   "'" + std::string(key) + "' = '" + path + "' cannot be read: " + file.reason,
                   "the path is relative to the scene's");
  };
  for (SupportRecord& support : document.supports)
    for (const auto& [history, key] : {std::pair{&support.history, "history"},
                                       {&support.velocity_history, "velocity_history"},
                                       {&support.acceleration_history, "acceleration_history"}})
      if (*history) read(**history, key, 3, support.locations);
  for (LoadRecord& load : document.loads)
    if (load.history && load.locations.usable("type"))
      read(*load.history, "history", load.type == Load::Kind::pressure ? 2 : 3, load.locations);
  for (QuietRecord& quiet : document.quiet_boundaries)
    if (quiet.incoming) read(*quiet.incoming, "incoming", 3, quiet.locations);
  for (QuakeRecord& quake : document.quakes) read(quake.acceleration, "acceleration", 3, quake.locations);
  return readable;
}

}  // namespace ddacontact::scene_format
