#include <ddacontact/solver/line_search.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

void LineSearch::clear() {
  springs_.clear();
  breaks_.clear();
}

void LineSearch::add(const ClippedSpring& spring, double rate) {
  springs_.push_back({spring, rate});
  if (spring.low == spring.high) return;
  for (double bound : {spring.low, spring.high}) {
    const double t = (spring.force - bound) / (spring.stiffness * rate);
    if (t > 0 && std::isfinite(t)) breaks_.push_back(t);
  }
}

ClippedSpring LineSearch::at(const Spring& spring, double t) const {
  ClippedSpring moved = spring.at_start;
  moved.force -= moved.stiffness * spring.rate * t;
  return moved;
}

double LineSearch::derivative(double t) const {
  double sum = slope_ + curvature_ * t;
  for (const Spring& spring : springs_) sum -= at(spring, t).clipped() * spring.rate;
  return sum;
}

double LineSearch::second_derivative(double t) const {
  double sum = curvature_;
  for (const Spring& spring : springs_)
    if (at(spring, t).acts()) sum += spring.at_start.stiffness * spring.rate * spring.rate;
  return sum;
}

// Every value is summed anew: sums that run from break to break keep the round-off of the stiffest spring
// after it has ceased to act.
double LineSearch::find_minimum(double slope, double curvature) {
  slope_ = slope;
  curvature_ = curvature;
  std::ranges::sort(breaks_);
  const auto after =
      std::partition_point(breaks_.begin(), breaks_.end(), [&](double t) { return derivative(t) < 0; });
  const double low = after == breaks_.begin() ? 0 : *(after - 1);
  const double inside = after == breaks_.end() ? 2 * low + 1 : low + (*after - low) / 2;
  const double t = low - derivative(low) / second_derivative(inside);
  if (!std::isfinite(t)) return inside;
  return after == breaks_.end() ? t : std::min(t, *after);
}

}  // namespace ddacontact
