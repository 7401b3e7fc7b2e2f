#include <ddacontact/core/time_function.hpp>

#include <ddacontact/core/tolerances.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace ddacontact {

namespace {

using Curve = std::vector<std::pair<Vec2, Vec2>>;

/// Between entries by `between(number of the one before, fraction)`; the first before them.
template <class Between, class After>
Vec2 look_up(const std::vector<Vec3>& history, double time, Between&& between, After&& after_last) {
  const auto after = std::upper_bound(history.begin(), history.end(), time,
                                      [](double t, const Vec3& entry) { return t < entry[0]; });
  assert(!history.empty());
  if (after == history.end()) return after_last(time - history.back()[0]);
  if (after == history.begin()) return between(std::size_t{0}, 0.0);
  const auto k = static_cast<std::size_t>(after - history.begin()) - 1;
  return between(k, (time - history[k][0]) / (history[k + 1][0] - history[k][0]));
}

Vec2 along_lines(const std::vector<Vec3>& history, double time) {
  return look_up(
      history, time,
      [&](std::size_t k, double s) -> Vec2 {
        if (s == 0) return history[k].tail<2>();
        return (1 - s) * history[k].tail<2>() + s * history[k + 1].tail<2>();
      },
      [&](double) -> Vec2 { return history.back().tail<2>(); });
}

/// The mean of along_lines, by trapezia: a step may hold hundreds of entries.
Vec2 mean_along_lines(const std::vector<Vec3>& history, const TimeSpan& span) {
  double time = span.from;
  Vec2 sum = Vec2::Zero(), value = along_lines(history, time);
  const auto add_to = [&](double next, const Vec2& there) {
    sum += (next - time) / 2 * (value + there);
    time = next;
    value = there;
  };
  const auto is_after = [](double t, const Vec3& entry) { return t < entry[0]; };
  auto entry = std::upper_bound(history.begin(), history.end(), span.from, is_after);
  for (; entry != history.end() && (*entry)[0] < span.to; ++entry) add_to((*entry)[0], entry->tail<2>());
  // Of a jump at the end of the span the value before it counts.
  const bool at_entry = entry != history.end() && (*entry)[0] == span.to;
  add_to(span.to, at_entry ? Vec2(entry->tail<2>()) : along_lines(history, span.to));
  return sum / (span.to - span.from);
}

/// The cubic polynomials with these values and derivatives at the entries; on with the last derivative.
Vec2 along_curve(const std::vector<Vec3>& history, const Curve& curve, double time) {
  return look_up(
      history, time,
      [&](std::size_t k, double s) -> Vec2 {
        const auto& [p, u] = curve[k];
        if (s == 0) return p;
        const auto& [q, v] = curve[k + 1];
        const double dt = history[k + 1][0] - history[k][0], r = 1 - s;
        return p + s * s * (1 + 2 * r) * (q - p) + s * r * dt * (r * u - s * v);
      },
      [&](double beyond) -> Vec2 { return curve.back().first + beyond * curve.back().second; });
}

/// The derivatives of the cubic spline that is at rest at both ends.
Curve spline(const std::vector<Vec3>& entries) {
  const std::size_t n = entries.size();
  Curve curve;
  for (const Vec3& entry : entries) curve.emplace_back(entry.tail<2>(), Vec2::Zero());
  // The tridiagonal equations of continuous second derivatives, eliminated downwards.
  std::vector<double> upper(n, 0);
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const double a = 1 / (entries[k][0] - entries[k - 1][0]), b = 1 / (entries[k + 1][0] - entries[k][0]);
    const Vec2 right =
        3 * (a * a * (curve[k].first - curve[k - 1].first) + b * b * (curve[k + 1].first - curve[k].first));
    const double pivot = 2 * (a + b) - a * upper[k - 1];
    upper[k] = b / pivot;
    curve[k].second = (right - a * curve[k - 1].second) / pivot;
  }
  for (std::size_t k = n; k-- > 1;) curve[k - 1].second -= upper[k - 1] * curve[k].second;
  return curve;
}

/// The integrals of values that are linear between entries, with these as derivatives.
Curve integral(const std::vector<Vec3>& entries) {
  Curve curve;
  Vec2 sum = Vec2::Zero();
  for (std::size_t k = 0; k < entries.size(); ++k) {
    if (k > 0) sum += (entries[k][0] - entries[k - 1][0]) / 2 * (entries[k - 1] + entries[k]).tail<2>();
    curve.emplace_back(sum, entries[k].tail<2>());
  }
  return curve;
}

/// The integrals of those integrals.
Curve second_integral(const std::vector<Vec3>& entries) {
  Curve curve = integral(entries);
  Vec2 sum = Vec2::Zero();
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const Vec2 velocity = curve[k].first;
    if (k > 0) {
      const double dt = entries[k][0] - entries[k - 1][0];
      sum += dt * curve[k - 1].second + dt * dt / 6 * (2 * entries[k - 1] + entries[k]).tail<2>();
    }
    curve[k] = {sum, velocity};
  }
  return curve;
}

/// The time of the entry from which on nothing changes.
double first_of_rest(const TimeFunction& function) {
  using Kind = TimeFunction::Kind;
  const std::vector<Vec3>& history = function.history;
  double first = history.back()[0];
  if (function.kind != Kind::history && function.kind != Kind::velocity_history) return first;
  const Vec2 rest = function.kind == Kind::history ? Vec2(history.back().tail<2>()) : Vec2::Zero();
  for (auto entry = history.rbegin(); entry != history.rend() && entry->tail<2>() == rest; ++entry)
    first = (*entry)[0];
  return first;
}

}  // namespace

Vec2 TimeFunction::at(double time, double end_time) const {
  const auto risen = [&]() -> Vec2 {
    switch (kind) {
      case Kind::constant:
        return value;
      case Kind::ramp:
        return (time < end_time ? std::max(0.0, (time - start) / (end_time - start)) : 1) * value;
      case Kind::rate:
        return time * value;
      case Kind::history:
        return along_lines(history, time);
      default:
        return along_curve(history, curve, time);
    }
  };
  const double part = rise > 0 ? std::clamp((time - start) / rise, 0.0, 1.0) : 1;
  return part * risen() - before;
}

/// Between the times at which it is no polynomial of the third degree two points integrate it.
Vec2 TimeFunction::mean(const TimeSpan& span, double end_time) const {
  if (span.from == span.to || (kind == Kind::constant && rise == 0)) return at(span.to, end_time);
  if (kind == Kind::history && span.from >= start + rise) return mean_along_lines(history, span) - before;
  std::vector<double> ends{span.from, start, start + rise, end_time, span.to};
  const auto is_before = [](const Vec3& entry, double time) { return entry[0] < time; };
  for (auto entry = std::lower_bound(history.begin(), history.end(), span.from, is_before);
       entry != history.end() && (*entry)[0] < span.to; ++entry)
    ends.push_back((*entry)[0]);
  std::erase_if(ends, [&](double time) { return time < span.from || time > span.to; });
  std::ranges::sort(ends);
  Vec2 sum = Vec2::Zero();
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const double middle = (ends[k] + ends[k + 1]) / 2, half = (ends[k + 1] - ends[k]) / 2,
                 off = half / std::numbers::sqrt3;
    sum += half * (at(middle - off, end_time) + at(middle + off, end_time));
  }
  return sum / (span.to - span.from);
}

double TimeFunction::last_change(double end_time) const {
  const double risen = rise > 0 ? start + rise : 0;
  if (kind == Kind::ramp && !value.isZero(0)) return std::max(risen, end_time);
  return is_history() ? std::max(risen, first_of_rest(*this)) : risen;
}

TimeFunction history_function(TimeFunction::Kind kind, std::vector<Vec3> entries) {
  TimeFunction function{kind, Vec2::Zero(), std::move(entries)};
  if (kind == TimeFunction::Kind::smooth_history) function.curve = spline(function.history);
  if (kind == TimeFunction::Kind::velocity_history) function.curve = integral(function.history);
  if (kind == TimeFunction::Kind::acceleration_history) function.curve = second_integral(function.history);
  return function;
}

double TimeFunction::rate(int axis, double time, double step, double end_time) const {
  constexpr double much = 4;
  const auto place = [&](int steps) { return at(time + steps * step, end_time)[axis]; };
  const auto way = [&](int steps) { return place(steps) - place(steps - 1); };
  const double last = way(0), next = way(1), jump = std::abs(next - last),
               beside = std::max(std::abs(last - way(-1)), std::abs(way(2) - next));
  return (jump > much * beside ? last : (last + next) / 2) / step;
}

TimeFunction zero_outside(TimeFunction function) {
  std::vector<Vec3>& entries = function.history;
  entries.insert(entries.begin(), {entries.front()[0], 0, 0});
  const double end = entries.back()[0];
  entries.push_back({end + few_ulps * std::abs(end), 0, 0});
  return function;
}

double sampling_error(const std::vector<Vec3>& entries) {
  if (entries.size() < 5) return 0;
  const Curve curve = spline(entries);
  Vec2 mean = Vec2::Zero();
  for (const Vec3& entry : entries) mean += entry.tail<2>() / static_cast<double>(entries.size());
  double errors = 0, values = 0;
  for (std::size_t k = 2; k + 2 < entries.size(); ++k) {  // the spline is made to rest at its ends
    const double dt = entries[k + 1][0] - entries[k][0];
    errors += (dt / 8 * (curve[k].second - curve[k + 1].second)).squaredNorm();
    values += (curve[k].first - mean).squaredNorm();
  }
  return values > 0 ? std::sqrt(errors / values) : 0;
}

}  // namespace ddacontact
