#include <tests/performance/page/quadrature_section.hpp>

#include <fmt/format.h>
#include <ddacontact/picture/chart.hpp>
#include <polyfem/core/error.hpp>

#include <fstream>
#include <sstream>

namespace benchmark_page {
namespace {

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

double number(const Row& row, const std::string& name) {
  return std::stod(row.at(name));
}

/// A rule with so many vertices; nothing when it was not measured.
const Row* find(const std::vector<Row>& rules, int n, const std::string& rule) {
  for (const Row& row : rules)
    if (row.at("n") == std::to_string(n) && row.at("rule") == rule) return &row;
  return nullptr;
}

struct Family {
  std::string name, before, after;  ///< a rule's name is before + number + after
};

const std::vector<Family> families{{"to a tolerance", "to tolerance 1e-", ""},
                                   {"symmetric", "symmetric degree ", ""},
                                   {"collapsed Gauss", "collapsed Gauss ", " grading 1"},
                                   {"collapsed, graded by 2", "collapsed Gauss ", " grading 2"},
                                   {"collapsed, graded by 3", "collapsed Gauss ", " grading 3"}};

bool belongs(const std::string& rule, const Family& family) {
  return rule.starts_with(family.before) && rule.ends_with(family.after);
}

ddacontact::Chart chart_of(const std::vector<Row>& rules, int n, bool against_time) {
  ddacontact::Chart chart;
  chart.x_logarithmic = chart.y_logarithmic = true;
  chart.y_symbol = {fmt::format("error of K, {} vertices", n), "", ""};
  chart.x_symbol = {against_time ? "time for the table" : "points", "", ""};
  chart.x_unit = against_time ? "s" : "";
  for (const Family& family : families) {
    ddacontact::Series line;
    line.name = family.name;
    line.dots = true;
    for (const Row& row : rules)
      if (row.at("n") == std::to_string(n) && belongs(row.at("rule"), family)) {
        line.x.push_back(against_time ? 1e-6 * number(row, "microseconds") : number(row, "points_median"));
        line.y.push_back(number(row, "K_median"));
      }
    if (line.x.empty()) throw polyfem::Error("no rules " + family.name + " were measured");
    chart.series.push_back(line);
  }
  return chart;
}

}  // namespace

std::vector<Row> read_rows(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> names = fields_of(line);
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    const std::vector<std::string> fields = fields_of(line);
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (k == 0) rows.emplace_back();
      rows.back()[names[k]] = k < fields.size() ? fields[k] : "";
    }
  }
  if (rows.empty()) throw polyfem::Error("\"" + path.string() + "\" has no rows");
  return rows;
}

std::string quadrature_picture(const std::vector<Row>& rules) {
  return ddacontact::draw({chart_of(rules, 6, false), chart_of(rules, 12, false), chart_of(rules, 6, true)},
                          {.title = "Stiffness of random convex polygons", .width = 720, .plot_height = 230});
}

Table points_table(const std::vector<Row>& rules) {
  const std::vector<std::string> tolerances{"1e-04", "1e-06", "1e-08", "1e-10"};
  Table table{{"vertices", "error of the paper's 4 points a triangle: median", "largest"}};
  for (const std::string& tolerance : tolerances) table[0].push_back("points for " + tolerance);
  for (int n = 3; n <= 12; ++n) {
    const Row* hammer = find(rules, n, "Hammer 4 points");
    if (!hammer) continue;
    table.push_back({std::to_string(n), fmt::format("{:.1e}", number(*hammer, "K_median")),
                     fmt::format("{:.1e}", number(*hammer, "K_max"))});
    for (const std::string& tolerance : tolerances) {
      const Row* row = find(rules, n, "to tolerance " + tolerance);
      table.back().push_back(row ? row->at("points_median") : "");
    }
  }
  return table;
}

Table tolerance_table(const std::vector<Row>& tolerances) {
  Table table{{"cells", "number", "tolerance", "missed", "reported as unmet", "points: median", "largest",
               "largest error of K", "of M", "median time, \u00b5s"}};
  for (const Row& row : tolerances)
    table.push_back({row.at("cells"), row.at("n_cells"), row.at("tolerance"), row.at("missed"),
                     row.at("reported_unmet"), row.at("points_median"), row.at("points_max"), row.at("K_max"),
                     row.at("M_max"), row.at("microseconds")});
  return table;
}

}  // namespace benchmark_page
