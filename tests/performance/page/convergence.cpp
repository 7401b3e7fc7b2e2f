#include <tests/performance/page/convergence.hpp>

#include <algorithm>
#include <cmath>

namespace benchmark_page {

std::vector<Series> series_of(const std::vector<Measurement>& table, const std::string& problem) {
  std::vector<Series> all;
  for (const Measurement& m : table) {
    if (m.problem != problem) continue;
    auto series = std::ranges::find(all, m.method, &Series::method);
    if (series == all.end()) series = all.insert(all.end(), {m.method, {}});
    auto level = std::ranges::find(series->levels, m.n_cells, &Measurement::n_cells);
    if (level == series->levels.end())
      series->levels.push_back(m);
    else if (m.total() < level->total())
      *level = m;
  }
  return all;
}

double rate(const Series& series, ErrorOf error) {
  double sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
  for (const Measurement& m : series.levels) {
    const double x = 0.5 * std::log(m.n_cells), y = -std::log(m.*error);
    sum_x += x;
    sum_y += y;
    sum_xx += x * x;
    sum_xy += x * y;
  }
  const auto n = static_cast<double>(series.levels.size());
  return (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x);
}

std::optional<double> time_to_reach(const Series& series, ErrorOf error, double wanted) {
  const auto& levels = series.levels;
  const auto reached = std::ranges::find_if(levels, [&](const Measurement& m) { return m.*error <= wanted; });
  if (reached == levels.end()) return std::nullopt;
  if (reached == levels.begin()) return reached->total();
  const Measurement &coarse = *(reached - 1), &fine = *reached;
  const double share = std::log(coarse.*error / wanted) / std::log(coarse.*error / (fine.*error));
  return coarse.total() * std::pow(fine.total() / coarse.total(), share);
}

}  // namespace benchmark_page
