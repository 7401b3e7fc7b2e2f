#include "plot_curves.hpp"

#include "call_error.hpp"
#include "energy_terms.hpp"
#include "result.hpp"

#include <fmt/format.h>
#include <ddacontact/output/csv_table.hpp>
#include <ddacontact/picture/chart.hpp>
#include <ddacontact/scene/spelling.hpp>

#include <algorithm>
#include <array>
#include <map>

namespace dda {

namespace fs = std::filesystem;
using namespace ddacontact;

namespace {

struct HistoryColumn {
  const char* name;
  Label symbol;
  const char* unit;
};

const std::array<HistoryColumn, 6> history_columns = {{{"x", {"x", "", ""}, "m"},
                                                       {"y", {"y", "", ""}, "m"},
                                                       {"ux", {"u", "x", ""}, "m"},
                                                       {"uy", {"u", "y", ""}, "m"},
                                                       {"vx", {"v", "x", ""}, "m/s"},
                                                       {"vy", {"v", "y", ""}, "m/s"}}};

const HistoryColumn& column_called(const std::string& name) {
  std::vector<std::string_view> known;
  for (const HistoryColumn& column : history_columns) {
    if (name == column.name) return column;
    known.emplace_back(column.name);
  }
  throw CallError(
      fmt::format("unknown history \"{}\" ({})", scene_format::excerpt(name), choice_among(name, known)));
}

/// The rows of each name, in the order of its first one.
struct Histories {
  std::vector<std::string> names;
  std::map<std::string, std::vector<std::size_t>> rows;
};

Histories rows_by_name(const std::vector<std::string>& column) {
  Histories histories;
  for (std::size_t i = 0; i < column.size(); ++i) {
    std::vector<std::size_t>& rows = histories.rows[column[i]];
    if (rows.empty()) histories.names.push_back(column[i]);
    rows.push_back(i);
  }
  return histories;
}

Histories histories_of(const CsvTable& table, const fs::path& directory,
                       const std::vector<std::string>& wanted) {
  Histories histories = rows_by_name(table.texts("monitor"));
  if (histories.names.empty())
    throw CallError(fmt::format("\"{}\" has no histories: its scene has no [[monitor]]", directory.string()));
  if (wanted.empty()) return histories;
  const std::vector<std::string_view> known(histories.names.begin(), histories.names.end());
  for (const std::string& name : wanted)
    if (!histories.rows.contains(name))
      throw CallError(fmt::format("\"{}\" has no monitor \"{}\" ({})", directory.string(),
                                  scene_format::excerpt(name), choice_among(name, known)));
  histories.names = wanted;
  return histories;
}

std::vector<double> chosen(const std::vector<double>& values, const std::vector<std::size_t>& rows) {
  std::vector<double> chosen;
  for (const std::size_t row : rows) chosen.push_back(values[row]);
  return chosen;
}

Chart empty_chart(const Label& symbol, const char* unit) {
  Chart chart;
  chart.x_symbol = {"time", "", ""};
  chart.x_unit = "s";
  chart.y_symbol = symbol;
  chart.y_unit = unit;
  return chart;
}

std::vector<Chart> history_charts(const PlotArguments& arguments) {
  std::vector<Chart> charts;
  for (const std::string& name : arguments.history) {
    const HistoryColumn& column = column_called(name);
    charts.push_back(empty_chart(column.symbol, column.unit));
  }
  if (charts.empty()) return charts;
  for (const std::string& name : arguments.directories) {
    expect_result_directory(name);
    const CsvTable table(fs::path(name) / "monitors.csv");
    const Histories histories = histories_of(table, name, arguments.monitors);
    const std::vector<double> time = table.numbers("time");
    for (std::size_t i = 0; i < charts.size(); ++i) {
      const std::vector<double> values = table.numbers(arguments.history[i]);
      for (const std::string& monitor : histories.names) {
        const std::string label = arguments.directories.size() > 1 ? name_of(name) + ": " + monitor : monitor;
        const std::vector<std::size_t>& rows = histories.rows.at(monitor);
        charts[i].series.push_back({label, chosen(time, rows), chosen(values, rows)});
      }
    }
  }
  return charts;
}

/// A chart of energies for each directory.
std::vector<Chart> energy_charts(const PlotArguments& arguments) {
  std::vector<Chart> charts;
  for (const std::string& name : arguments.directories) {
    expect_result_directory(name);
    const CsvTable table(fs::path(name) / "energy.csv");
    const std::vector<double> time = table.numbers("time");
    Chart chart =
        empty_chart({"energy", "", arguments.directories.size() > 1 ? " of " + name_of(name) : ""}, "J/m");
    for (EnergyCurve& curve : energy_curves(table))
      chart.series.push_back({curve.name, time, std::move(curve.values)});
    charts.push_back(std::move(chart));
  }
  return charts;
}

/// A column of energy.csv, a curve for each directory.
Chart step_chart(const PlotArguments& arguments, const char* column, const char* title, const char* unit) {
  Chart chart = empty_chart({title, "", ""}, unit);
  for (const std::string& name : arguments.directories) {
    expect_result_directory(name);
    const CsvTable table(fs::path(name) / "energy.csv");
    chart.series.push_back({name_of(name), table.numbers("time"), table.numbers(column)});
  }
  return chart;
}

/// A column of a file with rows by step, a curve for each name in another column.
///
/// \param[in] source  what a scene without the file lacks
Chart force_chart(const PlotArguments& arguments, const char* file, const char* source, const char* names,
                  const char* column, const char* title) {
  Chart chart = empty_chart({title, "", ""}, "N/m");
  for (const std::string& name : arguments.directories) {
    expect_result_directory(name);
    const fs::path path = fs::path(name) / file;
    std::error_code error;
    if (!fs::exists(path, error))
      throw CallError(fmt::format("\"{}\" has no {}: its scene has no [[{}]]", name, file, source));
    const CsvTable table(path);
    const std::vector<double> time = table.numbers("time"), force = table.numbers(column);
    const Histories of = rows_by_name(table.texts(names));
    for (const std::string& one : of.names)
      chart.series.push_back({arguments.directories.size() > 1 ? name_of(name) + ": " + one : one,
                              chosen(time, of.rows.at(one)), chosen(force, of.rows.at(one))});
  }
  return chart;
}

}  // namespace

std::string curves_picture(const PlotArguments& arguments) {
  ChartOptions options;
  if (arguments.width > 0) options.width = arguments.width;
  std::vector<Chart> charts = history_charts(arguments);
  if (arguments.energy)
    for (Chart& chart : energy_charts(arguments)) charts.push_back(std::move(chart));
  if (arguments.unbalanced) {
    charts.push_back(step_chart(arguments, "unbalanced", "out of balance", ""));
    charts.push_back(step_chart(arguments, "fastest", "largest velocity", "m/s"));
  }
  if (arguments.bolt_forces)
    charts.push_back(
        force_chart(arguments, "bolt_history.csv", "bolt", "bolt", "axial_force", "axial force"));
  if (arguments.reactions)
    for (const auto& [column, title] : {std::pair{"fx", "reaction fx"}, {"fy", "reaction fy"}})
      charts.push_back(force_chart(arguments, "support_history.csv", "support", "block", column, title));
  if (arguments.directories.size() == 1) {
    const fs::path directory(arguments.directories.front());
    options.title = title_of(directory, scene_of(directory));
  }
  return draw(charts, options);
}

}  // namespace dda
