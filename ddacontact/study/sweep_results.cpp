#include <ddacontact/study/sweep_results.hpp>

#include <ddacontact/core/types.hpp>
#include <ddacontact/output/csv_table.hpp>
#include <ddacontact/output/summary_reader.hpp>
#include <ddacontact/picture/chart.hpp>
#include <ddacontact/scene/text.hpp>
#include <ddacontact/scene/units.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

namespace ddacontact {

namespace {

constexpr std::string_view of_monitor = "monitor.";

/// The last row of a monitor; empty when it or the column is not there.
std::string at_monitor(const std::filesystem::path& directory, const std::string& path) {
  const std::size_t dot = path.rfind('.');
  const std::string monitor = path.substr(of_monitor.size(), dot - std::min(dot, of_monitor.size())),
                    column = path.substr(dot + 1);
  std::error_code error;
  if (!std::filesystem::exists(directory / "monitors.csv", error)) return "";
  const CsvTable table(directory / "monitors.csv");
  if (std::ranges::count(table.header(), column) == 0) return "";
  const std::vector<std::string> names = table.texts("monitor"), values = table.texts(column);
  for (std::size_t row = names.size(); row-- > 0;)
    if (names[row] == monitor) return values[row];
  return "";
}

std::string value_of(const Outcome& outcome, const SummaryTable& summary,
                     const std::filesystem::path& directory) {
  if (outcome.path.starts_with(of_monitor)) return at_monitor(directory, outcome.path);
  if (const std::optional<double> number = summary.number(outcome.path))
    return scene_format::short_number(*number);
  return summary.text(outcome.path);
}

/// Of a run, or of a search for the factor of safety; empty: none is finished.
std::filesystem::path summary_file(const std::filesystem::path& directory) {
  std::error_code error;
  for (const char* name : {"summary.json", "safety.json"})
    if (std::filesystem::exists(directory / name, error)) return directory / name;
  return {};
}

/// Of each row what was set besides two columns, "friction=20, seed=3".
std::vector<std::string> other_settings(const CsvTable& rows, const std::string& x, const std::string& y) {
  std::vector<std::string> texts(rows.n_rows());
  const std::vector<std::string>& header = rows.header();
  for (auto path = header.begin() + 1; path != header.end() && *path != "status"; ++path) {
    if (*path == x || *path == y) continue;
    const std::vector<std::string> values = rows.texts(*path);
    for (std::size_t k = 0; k < texts.size(); ++k)
      texts[k] += (texts[k].empty() ? "" : ", ") + *path + "=" + values[k];
  }
  return texts;
}

double largest_displacement(const std::filesystem::path& directory) {
  const CsvTable vertices(directory / "vertices.csv");
  const std::vector<double> ux = vertices.numbers("ux"), uy = vertices.numbers("uy");
  double largest = 0;
  for (std::size_t k = 0; k < ux.size(); ++k) largest = std::max(largest, std::hypot(ux[k], uy[k]));
  return largest;
}

/// The first line of a log that is no warning or note; the first one where all are.
std::string reason_of(const std::filesystem::path& log) {
  std::ifstream in(log);
  std::string first;
  for (std::string line; std::getline(in, line);) {
    if (line.find(": warning: ") == std::string::npos && line.find(": note: ") == std::string::npos)
      return line;
    if (first.empty()) first = line;
  }
  return first;
}

}  // namespace

std::optional<double> number_of(const std::string& text) {
  double number = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (status != std::errc() || !std::isfinite(number)) return std::nullopt;
  const std::string rest(static_cast<const char*>(end), text.data() + text.size());
  if (rest.empty()) return number;
  const auto unit = scene_format::parse_unit(rest.substr(std::min(rest.find_first_not_of(' '), rest.size())));
  if (!unit) return std::nullopt;
  const bool is_angle = unit->angle == 1 && unit->time == 0;
  return number * std::pow(10, unit->decade) * unit->factor * (is_angle ? 180 / std::numbers::pi : 1);
}

Outcome parse_outcome(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == text.size())
    throw Error("'" + text + "' is no outcome (write NAME=PATH)");
  return {text.substr(0, equals), text.substr(equals + 1)};
}

std::vector<Outcome> outcomes_of_safety() {
  return {{"factor_low", "factor_low"},
          {"factor_high", "factor_high"},
          {"rounded_corners", "rounded_corners.verdict"}};
}

std::string case_status(const std::filesystem::path& directory) {
  const std::filesystem::path file = summary_file(directory);
  return file.empty() ? "" : read_summary(file).text("status");
}

CaseResult read_case(const std::filesystem::path& directory, const std::vector<Outcome>& outcomes,
                     const std::filesystem::path& log) {
  CaseResult result;
  const std::filesystem::path file = summary_file(directory);
  if (file.empty()) {
    result.status = "failed";
    result.reason = reason_of(log);
    result.outcomes.resize(outcomes.size());
    return result;
  }
  const SummaryTable summary = read_summary(file);
  const auto number = [&](const char* key) { return summary.number(key).value_or(0); };
  const bool of_run = file.filename() == "summary.json";
  result.status = summary.text("status");
  result.reason = summary.text("reason");
  result.steps_completed = number("steps_completed");
  result.time = number("time");
  result.max_displacement = of_run ? largest_displacement(directory) : number("max_displacement");
  result.kinetic = number(of_run ? "energy.kinetic" : "kinetic");
  result.wall_seconds = number(of_run ? "wall_seconds.total" : "wall_seconds");
  for (const Outcome& outcome : outcomes) result.outcomes.push_back(value_of(outcome, summary, directory));
  return result;
}

bool has_outcome(const std::filesystem::path& directory, const Outcome& outcome) {
  if (outcome.path.starts_with(of_monitor)) return !at_monitor(directory, outcome.path).empty();
  const std::filesystem::path file = summary_file(directory);
  return !file.empty() && read_summary(file).keys.contains(outcome.path);
}

std::string curve_of(const std::filesystem::path& table, const std::string& x, const std::string& y) {
  constexpr std::size_t most_lines = 12;  // of colours that are told apart
  const CsvTable rows(table);
  const std::vector<std::string> xs = rows.texts(x), ys = rows.texts(y), status = rows.texts("status"),
                                 others = other_settings(rows, x, y);
  std::vector<std::string> names;  // of lines, in the order of the rows
  std::map<std::string, std::vector<std::pair<double, double>>> lines;
  std::size_t n_points = 0;
  for (std::size_t k = 0; k < xs.size(); ++k)
    if (const auto at = number_of(xs[k]), value = number_of(ys[k]); at && value && status[k] != "failed") {
      if (!lines.contains(others[k])) names.push_back(others[k]);
      lines[others[k]].emplace_back(*at, *value);
      ++n_points;
    }
  if (lines.empty()) throw Error("no case has numbers in both columns \"" + x + "\" and \"" + y + "\"");
  if (lines.size() == n_points) {  // the other settings go with x
    for (std::size_t k = 1; k < names.size(); ++k) lines[names[0]].push_back(lines[names[k]].front());
    names.resize(1);
  }
  const bool dots_alone = names.size() > most_lines;
  std::vector<Series> series;
  for (const std::string& name : names) {
    std::vector<std::pair<double, double>>& points = lines[name];
    std::ranges::sort(points);
    if (series.empty() || !dots_alone) series.push_back({.name = name, .x = {}, .y = {}, .dots = true});
    for (const auto& [at, value] : points) {
      series.back().x.push_back(at);
      series.back().y.push_back(value);
      if (!dots_alone) continue;
      series.back().x.push_back(at);
      series.back().y.push_back(std::numeric_limits<double>::quiet_NaN());
    }
  }
  const Chart chart{
      .x_symbol = {x, "", ""}, .y_symbol = {y, "", ""}, .x_unit = "", .y_unit = "", .series = series};
  return draw({chart}, {});
}

}  // namespace ddacontact
