#include <ddacontact/study/factor_distribution.hpp>

#include <ddacontact/core/types.hpp>
#include <ddacontact/picture/chart.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>

namespace ddacontact {

namespace {

constexpr int n_classes = 10, longest_bar = 40;

template <class... Values>
std::string text(const char* format, Values... values) {
  char line[200];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

/// Few patterns that hardly move would leave all others in one class: the outer classes take what lies beyond
/// these parts of the sorted factors.
constexpr double low_part = 0.025, high_part = 0.975;

double quantile(const std::vector<double>& sorted, double part) {
  return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1) + 0.5)];
}

std::string histogram(const std::vector<double>& factors) {
  const double least = quantile(factors, low_part),
               width = (quantile(factors, high_part) - least) / n_classes;
  if (width == 0) return "";
  std::vector<int> counts(n_classes);
  for (const double f : factors)
    ++counts[static_cast<int>(std::clamp((f - least) / width, 0.0, n_classes - 1.0))];
  const int most = *std::ranges::max_element(counts);
  std::string lines;
  for (int k = 0; k < n_classes; ++k) {
    const std::string from = k == 0 ? "" : text("%.3f", least + k * width),
                      to = k == n_classes - 1 ? "" : text("%.3f", least + (k + 1) * width),
                      bar(static_cast<std::size_t>((longest_bar * counts[k] + most - 1) / most), '#');
    lines += text("%8s .. %-8s %4d ", from.c_str(), to.c_str(), counts[k]) + bar + '\n';
  }
  return lines;
}

}  // namespace

double FactorDistribution::mean() const {
  return std::accumulate(factors.begin(), factors.end(), 0.0) / static_cast<double>(factors.size());
}

double FactorDistribution::median() const {
  return (factors[(factors.size() - 1) / 2] + factors[factors.size() / 2]) / 2;
}

double FactorDistribution::standard_deviation() const {
  if (factors.size() < 2) return 0;
  double squares = 0;
  for (const double f : factors) squares += (f - mean()) * (f - mean());
  return std::sqrt(squares / static_cast<double>(factors.size() - 1));
}

int FactorDistribution::n_failing() const {
  return n_always + static_cast<int>(std::ranges::lower_bound(factors, 1.0) - factors.begin());
}

double FactorDistribution::probability_of_failure() const {
  return static_cast<double>(n_failing()) / n_cases();
}

double FactorDistribution::standard_error() const {
  const double p = probability_of_failure();
  return std::sqrt(p * (1 - p) / n_cases());
}

FactorDistribution distribution_of(const std::vector<std::string>& low,
                                   const std::vector<std::string>& high) {
  FactorDistribution found;
  for (std::size_t k = 0; k < low.size(); ++k) {
    const double rests_at = std::strtod(low[k].c_str(), nullptr),
                 moves_at = std::strtod(high[k].c_str(), nullptr);
    if (low[k].empty() && high[k].empty())
      ++found.n_unknown;
    else if (!low[k].empty() && !high[k].empty())
      found.factors.push_back((rests_at + moves_at) / 2);
    else if (low[k].empty())
      ++(moves_at <= 1 ? found.n_always : found.n_move_above);
    else
      ++(rests_at >= 1 ? found.n_never : found.n_rest_below);
  }
  std::ranges::sort(found.factors);
  return found;
}

std::string describe(const FactorDistribution& distribution) {
  const std::string unknown = distribution.n_unknown == 0
                                  ? ""
                                  : text(
                                        "without a factor, and counted nowhere: %d of the cases (see "
                                        "'status' and 'reason' in sweep.csv)\n",
                                        distribution.n_unknown);
  if (distribution.n_cases() == 0) return "no case has a factor of safety\n" + unknown;
  const std::vector<double>& factors = distribution.factors;
  std::string lines;
  if (!factors.empty())
    lines += text(
                 "factor of safety of %zu cases: median %.4g, mean %.4g, standard deviation %.2g, from %.4g "
                 "to %.4g\n",
                 factors.size(), distribution.median(), distribution.mean(),
                 distribution.standard_deviation(), factors.front(), factors.back()) +
             histogram(factors);
  const auto tell = [&](int n, const char* what) {
    if (n > 0) lines += text("%d cases %s\n", n, what);
  };
  tell(distribution.n_always, "move at every factor that was tried");
  tell(distribution.n_never, "rest at every factor that was tried");
  tell(distribution.n_move_above, "move at every factor with a verdict, all of them above 1");
  tell(distribution.n_rest_below, "rest at every factor with a verdict, all of them below 1");
  const int failing = distribution.n_failing(), n_cases = distribution.n_cases();
  if (const int n = distribution.n_undecided(); n > 0)
    return lines +
           text(
               "probability of failure (factor below 1): %d to %d of %d cases (a --range from below 1 to "
               "above it)\n",
               failing, failing + n, n_cases) +
           unknown;
  return lines +
         text("probability of failure (factor below 1): %d of %d cases, %.3g +- %.2g\n", failing, n_cases,
              distribution.probability_of_failure(), distribution.standard_error()) +
         unknown;
}

std::string draw(const FactorDistribution& distribution) {
  if (distribution.factors.empty()) throw Error("no case has a factor of safety to be drawn");
  Series steps{.name = "part of the cases", .x = {}, .y = {}};
  int below = distribution.n_always + distribution.n_move_above;
  for (const double f : distribution.factors) {
    if (f > quantile(distribution.factors, high_part)) break;
    for (const int more : {0, 1}) {
      steps.x.push_back(f);
      steps.y.push_back(static_cast<double>(below += more) / distribution.n_cases());
    }
  }
  const Chart chart{
      .x_symbol = {"F", "", ""}, .y_symbol = {"P", "", ""}, .x_unit = "", .y_unit = "", .series = {steps}};
  return draw({chart}, {.title = "Part of the cases with a factor of safety below F"});
}

}  // namespace ddacontact
