#include "view_histories.hpp"

#include "energy_terms.hpp"

#include <fmt/format.h>
#include <ddacontact/output/csv_table.hpp>
#include <ddacontact/output/summary_reader.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace dda {

namespace fs = std::filesystem;
using namespace ddacontact;

namespace {

bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

/// A curve of `column` for each name in the column `names`.
void add_curves(const CsvTable& table, const char* names, const char* column, const char* unit,
                const std::string& group, std::vector<PageHistory>& histories) {
  const std::vector<std::string> name_of = table.texts(names);
  const std::vector<double> times = table.numbers("time"), values = table.numbers(column);
  std::vector<PageHistory> curves;
  std::map<std::string, std::size_t> curve_of;
  for (std::size_t row = 0; row < name_of.size(); ++row) {
    const auto [location, is_new] = curve_of.try_emplace(name_of[row], curves.size());
    if (is_new) curves.push_back({name_of[row], unit, group, {}, {}});
    curves[location->second].times.push_back(times[row]);
    curves[location->second].values.push_back(values[row]);
  }
  for (PageHistory& curve : curves) histories.push_back(std::move(curve));
}

void add_monitors(const fs::path& path, std::vector<PageHistory>& histories) {
  const CsvTable table(path);
  for (const auto& [column, unit] : {std::pair{"ux", "m"}, {"uy", "m"}, {"vx", "m/s"}, {"vy", "m/s"}})
    add_curves(table, "monitor", column, unit, std::string("monitors: ") + column, histories);
}

void add_bolts(const fs::path& path, std::vector<PageHistory>& histories) {
  add_curves(CsvTable(path), "bolt", "axial_force", "N/m", "axial force of bolts", histories);
}

void add_supports(const fs::path& path, std::vector<PageHistory>& histories) {
  const CsvTable table(path);
  for (const char* column : {"fx", "fy"})
    add_curves(table, "block", column, "N/m", std::string("reactions: ") + column, histories);
}

/// Energies, and how far from equilibrium the blocks are: each in a chart of its own.
void add_energies(const fs::path& path, std::vector<PageHistory>& histories) {
  const CsvTable table(path);
  const std::vector<double> times = table.numbers("time");
  const auto add = [&](const char* column, const char* name, const char* unit, const char* group) {
    if (std::ranges::count(table.header(), column) == 0) return;  // results of an older version
    std::vector<double> values = table.numbers(column);
    if (std::any_of(values.begin(), values.end(), [](double value) { return value != 0; }))
      histories.push_back({name, unit, group, times, std::move(values)});
  };
  for (EnergyCurve& curve : energy_curves(table))
    histories.push_back({curve.name, "J/m", "energy", times, std::move(curve.values)});
  add("unbalanced", "unbalanced", "", "largest force out of balance");
  add("fastest", "fastest", "m/s", "largest velocity");
}

}  // namespace

std::vector<PageHistory> histories_of(const fs::path& directory) {
  std::vector<PageHistory> histories;
  if (is_there(directory / "monitors.csv")) add_monitors(directory / "monitors.csv", histories);
  if (is_there(directory / "bolt_history.csv")) add_bolts(directory / "bolt_history.csv", histories);
  if (is_there(directory / "support_history.csv")) add_supports(directory / "support_history.csv", histories);
  if (is_there(directory / "energy.csv")) add_energies(directory / "energy.csv", histories);
  return histories;
}

std::vector<std::string> verdict_of(const fs::path& directory) {
  if (!is_there(directory / "summary.json")) return {};
  const SummaryTable summary = read_summary(directory / "summary.json");
  std::vector<std::string> lines;
  std::string ended = summary.text("status");
  if (const auto steps = summary.number("steps_completed")) ended += fmt::format(", {:.0f} steps", *steps);
  if (const auto time = summary.number("time")) ended += fmt::format(", t = {:.4g} s", *time);
  lines.push_back(ended);
  if (const std::string reason = summary.text("reason"); !reason.empty()) lines.push_back(reason);
  if (const auto at_rest = summary.number("at_rest"))
    lines.push_back(*at_rest != 0 ? "at rest" : "not at rest");
  for (int k = 0;; ++k) {
    const std::string warning = summary.text("warnings." + std::to_string(k));
    if (warning.empty()) return lines;
    lines.push_back("warning: " + warning);
  }
}

}  // namespace dda
