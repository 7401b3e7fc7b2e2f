#include <tests/performance/error_time/comparison.hpp>

#include <algorithm>
#include <cmath>

namespace error_time {

double Frontier::error_at(double time) const {
  const auto after = std::ranges::upper_bound(seconds, time);
  if (after == seconds.end()) return errors.back();
  const std::size_t k = static_cast<std::size_t>(std::max<std::ptrdiff_t>(1, after - seconds.begin()));
  const double part = std::log(time / seconds[k - 1]) / std::log(seconds[k] / seconds[k - 1]);
  return errors[k - 1] * std::pow(errors[k] / errors[k - 1], std::max(part, 0.));
}

Frontier frontier(const std::vector<Measurement>& all, const std::string& quantity,
                  const std::string& method) {
  std::vector<std::pair<double, double>> runs;
  for (const Measurement& m : all)
    if (m.quantity == quantity && m.method == method && m.seconds > 0)
      runs.emplace_back(m.seconds, std::isfinite(m.error) ? std::min(m.error, 1.) : 1.);
  std::ranges::sort(runs);
  Frontier found;
  for (const auto& [seconds, error] : runs)
    if (found.empty() || error < found.errors.back()) {
      found.seconds.push_back(seconds);
      found.errors.push_back(error);
    }
  return found;
}

std::optional<Lead> lead_of(const Frontier& one, const Frontier& other) {
  if (one.empty() || other.empty()) return std::nullopt;
  const double from = std::max(one.seconds.front(), other.seconds.front());
  std::vector<double> times{from};  // between them both are straight lines of logarithms
  for (const Frontier* of : {&one, &other})
    for (const double time : of->seconds)
      if (time > from) times.push_back(time);
  Lead lead{INFINITY, from, 0, from};
  for (const double time : times) {
    const double ratio = other.error_at(time) / one.error_at(time);
    if (ratio < lead.least) lead.least = ratio, lead.least_at = time;
    if (ratio > lead.most) lead.most = ratio, lead.most_at = time;
  }
  return lead;
}

}  // namespace error_time
