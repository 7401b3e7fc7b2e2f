#include <tests/performance/page/kernel_section.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <polyfem/core/error.hpp>

#include <fstream>

namespace benchmark_page {
namespace {

/// A point's share where a benchmark's iteration has many.
std::string nanoseconds(const KernelTimes& times, const std::string& name, int n_points = 1) {
  const auto time = times.find(name);
  if (time == times.end()) throw polyfem::Error("no time of \"" + name + "\" was measured");
  const double value = time->second / n_points;
  return fmt::format("{:.{}f}", value, value < 99.5 ? 1 : 0);
}

}  // namespace

KernelTimes kernel_times(const std::filesystem::path& path) try {
  const std::map<std::string, double> nanoseconds{{"ns", 1}, {"us", 1e3}, {"ms", 1e6}, {"s", 1e9}};
  std::ifstream file(path);
  const nlohmann::json report = nlohmann::json::parse(file);
  KernelTimes times;
  for (const auto& entry : report.at("benchmarks"))
    if (entry.value("aggregate_name", "median") == "median")
      times[entry.at("run_name")] =
          entry.at("cpu_time").get<double>() * nanoseconds.at(entry.at("time_unit"));
  return times;
} catch (const std::exception& error) {
  throw polyfem::Error("\"" + path.string() + "\" is no report of Google Benchmark: " + error.what());
}

Table quadrilateral_table(const KernelTimes& times) {
  return {
      {"stiffness of a general quadrilateral, 2 x 2 points", "ns"},
      {"polyfem: rule, Wachspress functions with correction, K",
       nanoseconds(times, "QuadrilateralStiffness")},
      {"deal.II: `FEValues::reinit` and the loop for K", nanoseconds(times, "DealIIQuadrilateralStiffness")},
      {"of it `FEValues::reinit`", nanoseconds(times, "DealIIReinit")}};
}

Table element_table(const KernelTimes& times) {
  Table table{{"ns for an n-gon, 4 points a triangle", "rule", "functions, corrected", "K", "M"}};
  for (const int n : {3, 4, 6, 8, 12}) {
    const std::string sizes = fmt::format("/n:{}/degree:3", n);
    table.push_back({fmt::format("n = {}", n), nanoseconds(times, fmt::format("FanRule/{}", n)),
                     nanoseconds(times, "Tabulate<GradientCorrection::on>" + sizes),
                     nanoseconds(times, "Stiffness" + sizes), nanoseconds(times, "Mass" + sizes)});
  }
  return table;
}

Table basis_table(const std::string& basis, const KernelTimes& generic, const KernelTimes& native) {
  Table table{{"ns a point", "polyfem", "CGAL fast", "CGAL precise", "polyfem, native", "CGAL fast, native",
               "CGAL precise, native"}};
  for (const int n : {4, 5, 6, 8, 10, 12, 16, 20}) {
    table.push_back({fmt::format("n = {}", n)});
    for (const KernelTimes& times : {generic, native})
      for (const std::string& who : {basis, "cgal_" + basis + "_fast", "cgal_" + basis + "_precise"})
        table.back().push_back(nanoseconds(times, fmt::format("{}/inside/n:{}/points:16", who, n), 16));
  }
  return table;
}

}  // namespace benchmark_page
