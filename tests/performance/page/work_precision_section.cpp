#include <tests/performance/page/work_precision_section.hpp>

#include <fmt/format.h>
#include <ddacontact/picture/chart.hpp>

#include <algorithm>
#include <cmath>

namespace benchmark_page {
namespace {

std::string milliseconds(double seconds) {
  const double value = 1e3 * seconds;
  return value >= 99.5 ? fmt::format("{:.0f}", value) : fmt::format("{:.2g}", value);
}

/// The largest error that each method of first order reaches on its finest mesh; of those that lock none
/// does.
double common_error(const std::vector<Series>& all, ErrorOf error) {
  const auto first_order = [](const Series& series) {
    return !series.method.ends_with("quadratic") && series.method != "deal.II Q2";
  };
  double least_l2 = INFINITY, common = 0;
  for (const Series& series : all)
    if (first_order(series)) least_l2 = std::min(least_l2, series.levels.back().l2);
  for (const Series& series : all)
    if (first_order(series) && series.levels.back().l2 < 20 * least_l2)
      common = std::max(common, series.levels.back().*error);
  return common;
}

double n_unknowns(const Measurement& m) {
  return m.n_unknowns;
}

template <class Abscissa>
ddacontact::Chart chart_of(const std::vector<Series>& all, Abscissa abscissa, ErrorOf error) {
  ddacontact::Chart chart;
  chart.x_logarithmic = chart.y_logarithmic = true;
  for (const Series& series : all) {
    ddacontact::Series line;
    line.name = series.method;
    line.dots = true;
    for (const Measurement& m : series.levels) {
      line.x.push_back(abscissa(m));
      line.y.push_back(m.*error);
    }
    chart.series.push_back(line);
  }
  return chart;
}

/// The slope of a rate, through a point a little below the highest error at the least number of unknowns.
ddacontact::Series slope(const ddacontact::Chart& chart, int order) {
  double left = INFINITY, right = 0, top = 0;
  for (const ddacontact::Series& line : chart.series) {
    left = std::min(left, line.x.front());
    right = std::max(right, line.x.back());
    top = std::max(top, line.y.front());
  }
  ddacontact::Series guide;
  guide.name = order == 1 ? "h" : "h\u00b2";
  guide.guide = true;
  guide.x = {left, right};
  guide.y = {1.3 * top, 1.3 * top * std::pow(left / right, order / 2.)};
  return guide;
}

}  // namespace

Table finest_meshes(const std::vector<Series>& all, const std::string& first_error) {
  Table table{{"", "cells", "unknowns", first_error, "rate", "energy error", "rate", "pattern", "assembly",
               "factorization", "solution", "total, ms", "by"}};
  for (const Series& series : all) {
    const Measurement& m = series.levels.back();
    table.push_back({series.method, std::to_string(m.n_cells), std::to_string(m.n_unknowns),
                     fmt::format("{:.2e}", m.l2), fmt::format("{:.2f}", rate(series, &Measurement::l2)),
                     fmt::format("{:.2e}", m.energy),
                     fmt::format("{:.2f}", rate(series, &Measurement::energy)), milliseconds(m.pattern),
                     milliseconds(m.assembly), milliseconds(m.factorization), milliseconds(m.solve),
                     milliseconds(m.total()), m.solver});
  }
  return table;
}

Table times_to_errors(const std::vector<Series>& all, const std::string& name, ErrorOf error,
                      const std::vector<double>& multiples, const std::vector<double>& further) {
  std::vector<double> wanted;
  for (const double multiple : multiples) wanted.push_back(multiple * common_error(all, error));
  wanted.insert(wanted.end(), further.begin(), further.end());
  Table table{{name + ", ms"}};
  for (const Series& series : all) table[0].push_back(series.method);
  for (const double least : wanted) {
    table.push_back({fmt::format("{:.1e}", least)});
    for (const Series& series : all) {
      const auto time = time_to_reach(series, error, least);
      const bool coarsest = series.levels.front().*error <= least;
      table.back().push_back(!time      ? "not reached"
                             : coarsest ? "< " + milliseconds(*time)
                                        : milliseconds(*time));
    }
  }
  return table;
}

std::string work_precision_picture(const std::string& title, const std::vector<Series>& all,
                                   const std::string& first_error) {
  const auto time = [](const Measurement& m) { return m.total(); };
  std::vector<ddacontact::Chart> charts{chart_of(all, n_unknowns, &Measurement::l2),
                                        chart_of(all, time, &Measurement::l2),
                                        chart_of(all, time, &Measurement::energy)};
  charts[0].series.push_back(slope(charts[0], 2));
  for (std::size_t k = 0; k < charts.size(); ++k) {
    charts[k].y_symbol = {k == 2 ? "energy error" : first_error, "", ""};
    charts[k].x_symbol = {k == 0 ? "unknowns" : "time", "", ""};
    charts[k].x_unit = k == 0 ? "" : "s";
  }
  return ddacontact::draw(charts, {.title = title, .width = 720, .plot_height = 230});
}

}  // namespace benchmark_page
