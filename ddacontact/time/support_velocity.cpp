#include <ddacontact/time/support_velocity.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

double support_velocity(const PrescribedDof& held, double time, double dt, double end_time) {
  constexpr double much = 4;
  double way[4];  // in the steps that end at time - dt, time, ...
  Vec2 before = held.motion.at(time - 2 * dt, end_time);
  for (int k = 0; k < 4; ++k) {
    const Vec2 after = held.motion.at(time + (k - 1) * dt, end_time);
    way[k] = (after - before)[held.axis];
    before = after;
  }
  const double jump = std::abs(way[2] - way[1]),
               beside = std::max(std::abs(way[1] - way[0]), std::abs(way[3] - way[2]));
  return (jump > much * beside ? way[1] : (way[1] + way[2]) / 2) / dt;
}

}  // namespace ddacontact
