#include <ddacontact/time/support_velocity.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

double support_velocity(const PrescribedDof& held, double time, double dt, double end_time) {
  constexpr double much = 4;
  const auto place = [&](int steps) { return held.motion.at(time + steps * dt, end_time)[held.axis]; };
  const auto way = [&](int steps) { return place(steps) - place(steps - 1); };
  const double last = way(0), next = way(1), jump = std::abs(next - last),
               beside = std::max(std::abs(last - way(-1)), std::abs(way(2) - next));
  return (jump > much * beside ? last : (last + next) / 2) / dt;
}

}  // namespace ddacontact
