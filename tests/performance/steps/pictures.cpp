#include "pictures.hpp"

#include <fmt/format.h>
#include <ddacontact/picture/chart.hpp>

#include <algorithm>
#include <array>

namespace step_performance {

namespace {

using ddacontact::Chart;
using ddacontact::Series;

Chart empty_chart() {
  return {.x_symbol = {"blocks", "", ""},
          .y_symbol = {"time per block and step", "", ""},
          .x_unit = "",
          .y_unit = "s",
          .series = {},
          .x_logarithmic = true,
          .y_logarithmic = true};
}

template <class SecondsOf>
Series line_of_seconds(const std::string& name, const std::vector<Measurement>& rows,
                       const SecondsOf& seconds) {
  Series line;
  line.name = name;
  line.dots = true;
  for (const Measurement& row : rows) {
    line.x.push_back(row.blocks);
    line.y.push_back(seconds(row) / row.blocks);
  }
  return line;
}

}  // namespace

std::vector<SizeSeries> size_series(std::span<const Measurement> table) {
  std::vector<SizeSeries> all;
  for (const Measurement& row : table) {
    if (row.total <= 0) continue;
    std::string name = fmt::format("{}, {}, {} s", row.scene, row.start, row.time_step);
    if (row.method != "default") name += fmt::format(", {}", row.method);
    if (!row.without.empty()) name += fmt::format(", without {}", row.without);
    if (row.threads > 1) name += fmt::format(", {} threads", row.threads);
    auto same = std::ranges::find(all, name, &SizeSeries::name);
    if (same == all.end()) same = all.insert(all.end(), {name, {}});
    same->rows.push_back(row);
  }
  for (SizeSeries& series : all) std::ranges::sort(series.rows, {}, &Measurement::blocks);
  return all;
}

std::string phase_picture(const SizeSeries& series) {
  struct Phase {
    const char* name;
    double Measurement::*seconds;
  };
  constexpr std::array phases{Phase{"total", &Measurement::total},
                              Phase{"detection", &Measurement::detection},
                              Phase{"assembly", &Measurement::assembly},
                              Phase{"analysis", &Measurement::analysis},
                              Phase{"factorization", &Measurement::factorization},
                              Phase{"solution", &Measurement::solution},
                              Phase{"rest of the solver", &Measurement::solver},
                              Phase{"update", &Measurement::update}};
  Chart chart = empty_chart();
  for (const Phase& phase : phases)
    chart.series.push_back(
        line_of_seconds(phase.name, series.rows, [&](const Measurement& row) { return row.*phase.seconds; }));
  Series cholmod =
      line_of_seconds("CHOLMOD, once", series.rows, [](const Measurement& row) { return row.cholmod(); });
  cholmod.guide = true;
  cholmod.dots = false;
  chart.series.push_back(cholmod);
  return ddacontact::draw({chart}, {.title = series.name, .width = 720, .plot_height = 260});
}

std::string total_picture(const std::string& title, std::span<const SizeSeries> all) {
  Chart chart = empty_chart();
  for (const SizeSeries& series : all)
    chart.series.push_back(
        line_of_seconds(series.name, series.rows, [](const Measurement& row) { return row.total; }));
  return ddacontact::draw({chart}, {.title = title, .width = 720, .plot_height = 300});
}

}  // namespace step_performance
