#include <tests/performance/error_time/swaying.hpp>

#include <mechanics_scenes.hpp>

#include <cmath>

namespace error_time {

using namespace verification;

namespace {

constexpr double amplitude = 1.5, pulsation = 2 * turn;  // m/s2, rad/s
constexpr double entry = 1e-4;                           // s, of the history that states it

}  // namespace

Vec2 SwayingSlide::down() const {
  return {std::cos(radians(slope)), -std::sin(radians(slope))};
}

Load SwayingSlide::force(int block, double density, double start, double duration) const {
  Load load;
  load.kind = Load::Kind::body;
  load.block = block;
  load.force.kind = TimeFunction::Kind::history;
  for (double t = 0; t < duration + 0.1; t += entry) {
    const Vec2 force = density * amplitude * std::sin(pulsation * t) * down();
    load.force.history.emplace_back(start + t, force.x(), force.y());
  }
  return load;
}

double SwayingSlide::way(double t) const {
  const double steady =
      gravity * (std::sin(radians(slope)) - std::cos(radians(slope)) * std::tan(radians(friction)));
  return steady * t * t / 2 + amplitude / (pulsation * pulsation) * (pulsation * t - std::sin(pulsation * t));
}

}  // namespace error_time
