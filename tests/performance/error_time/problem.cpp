#include <tests/performance/error_time/problem.hpp>

#include <ddacontact/time/monitor_target.hpp>

namespace error_time {

ddacontact::Vec2 way(const ddacontact::Stepper& stepper, int block) {
  return ddacontact::observe({"", ddacontact::Centroid{block}}, stepper).displacement;
}

std::vector<Problem> all_problems() {
  return {sliding(), colliding(), wave(), arch(), resting_slope(), sliding_slope()};
}

}  // namespace error_time
