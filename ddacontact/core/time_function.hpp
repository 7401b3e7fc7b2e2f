/// \file A vector that depends on time, as loads and supports state it.
#pragma once

#include <ddacontact/core/types.hpp>

#include <vector>

namespace ddacontact {

/// A force, displacement or the like as a function of time.
struct TimeFunction {
  enum class Kind {
    constant,  ///< `value` at all times
    ramp,      ///< grows linearly from 0 to `value` at the scene's end time, then constant
    rate,      ///< `value` times t
    history    ///< linear between the entries (t, x, y), constant outside
  };
  Kind kind = Kind::constant;
  Vec2 value{0, 0};
  std::vector<Vec3> history;

  /// `end_time` is the length the scene itself states: steps times time_step, of all stages.
  Vec2 at(double time, double end_time) const;
};

}  // namespace ddacontact
