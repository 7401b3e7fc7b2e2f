#include <ddacontact/solver/line_search.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ddacontact {

// Every value is summed anew: sums that run from break to break keep the round-off of the stiffest spring
// after it has ceased to act.
double minimum_along(std::span<const LineSpring> springs, double slope, double curvature) {
  std::vector<double> breaks;  // t > 0 at which a spring begins or ceases to follow its form
  for (const auto& [spring, rate] : springs)
    for (double bound : {spring.low, spring.high}) {
      const double t = (spring.force - bound) / (spring.stiffness * rate);
      if (spring.low < spring.high && t > 0 && std::isfinite(t)) breaks.push_back(t);
    }
  std::ranges::sort(breaks);
  const auto derivative = [&](double t) {
    double sum = slope + curvature * t;
    for (const LineSpring& of : springs) sum -= of.at(t).clipped() * of.rate;
    return sum;
  };
  const auto after =
      std::partition_point(breaks.begin(), breaks.end(), [&](double t) { return derivative(t) < 0; });
  const double low = after == breaks.begin() ? 0 : *(after - 1);
  const double inside = after == breaks.end() ? 2 * low + 1 : low + (*after - low) / 2;
  double second = curvature;
  for (const LineSpring& of : springs)
    if (of.at(inside).acts()) second += of.at_start.stiffness * of.rate * of.rate;
  const double t = low - derivative(low) / second;
  if (!std::isfinite(t)) return inside;
  return after == breaks.end() ? t : std::min(t, *after);
}

}  // namespace ddacontact
