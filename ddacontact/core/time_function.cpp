#include <ddacontact/core/time_function.hpp>

#include <algorithm>

namespace ddacontact {

namespace {

Vec2 interpolate(const std::vector<Vec3>& history, double time) {
  const auto after = std::upper_bound(history.begin(), history.end(), time,
                                      [](double t, const Vec3& entry) { return t < entry[0]; });
  if (after == history.begin()) return history.front().tail<2>();
  if (after == history.end()) return history.back().tail<2>();
  const Vec3 &a = *(after - 1), &b = *after;
  const double s = (time - a[0]) / (b[0] - a[0]);
  return (1 - s) * a.tail<2>() + s * b.tail<2>();
}

}  // namespace

Vec2 TimeFunction::at(double time, double end_time) const {
  switch (kind) {
    case Kind::constant:
      return value;
    case Kind::ramp:
      return value * std::clamp(time / end_time, 0.0, 1.0);
    case Kind::rate:
      return value * time;
    case Kind::history:
      return interpolate(history, time);
  }
  return value;
}

}  // namespace ddacontact
