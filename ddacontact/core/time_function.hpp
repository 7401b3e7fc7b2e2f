/// \file A vector that depends on time, as loads and supports state it.
#pragma once

#include <ddacontact/core/types.hpp>

#include <utility>
#include <vector>

namespace ddacontact {

/// From one time to another, or a single one, s.
struct TimeSpan {
  double from, to;

  TimeSpan(double begin, double end) : from(begin), to(end) {}
  TimeSpan(double time) : TimeSpan(time, time) {}  // NOLINT: a time is a span of no length
  double middle() const { return (from + to) / 2; }
};

/// A force, displacement or the like as a function of time.
struct TimeFunction {
  enum class Kind {
    constant,          ///< `value` at all times
    ramp,              ///< grows linearly from 0 at `start` to `value` at the scene's end time, then constant
    rate,              ///< `value` times t
    history,           ///< linear between the entries (t, x, y), constant outside
    smooth_history,    ///< a cubic spline through the entries, at rest before and after them
    velocity_history,  ///< the integral of what is linear between the entries, 0 at the first of them
    acceleration_history,  ///< the integral of that, at rest before the first entry
  };
  Kind kind = Kind::constant;
  Vec2 value{0, 0};
  std::vector<Vec3> history{};  ///< entries (t, x, y), t ascending
  /// Values and derivatives at the entries, between which the function is cubic, of kinds after `history`.
  std::vector<std::pair<Vec2, Vec2>> curve{};
  double rise = 0;    ///< s, in which all of it grows linearly from nothing
  double start = 0;   ///< of that and of a ramp, s
  Vec2 before{0, 0};  ///< taken off: what had come by the time that counts as its beginning

  bool is_history() const { return kind >= Kind::history; }
  /// `end_time` is the length the scene itself states: steps times time_step, of all stages.
  Vec2 at(double time, double end_time) const;
  /// Its mean over a span: what a step takes of it has the whole impulse, however short a pulse is.
  Vec2 mean(const TimeSpan& span, double end_time) const;
  /// Its rate from time 0 on, by its values within a step: exact where it is a polynomial of the second
  /// degree.
  Vec2 rate_at_start(double step, double end_time) const {
    return (4 * at(step / 2, end_time) - at(step, end_time) - 3 * at(0, end_time)) / step;
  }
  /// The rate of its x (axis 0) or y, by its values up to two steps beside: that before it where the rate
  /// jumps.
  double rate(int axis, double time, double step, double end_time) const;
  /// Counts from here on what it changes by: 0 at `time`.
  void begin(double time, double end_time) {
    start = time;
    before = at(time, end_time);
  }
  /// When it stops changing, s; 0 where it never changes or goes on at its rate for ever.
  double last_change(double end_time) const;
  bool changes_between(double from, double to, double end_time) const {
    return at(from, end_time) != at(to, end_time);
  }
};

/// Of entries in the sense of the kind, one of the histories.
TimeFunction history_function(TimeFunction::Kind kind, std::vector<Vec3> entries);

/// A history that is 0 before its first entry and after its last one.
TimeFunction zero_outside(TimeFunction history);

/// How far lines between the entries are from a cubic spline through them, of the entries' deviation from
/// their mean, both as root mean squares: (2 pi / n)^2 / 8 for a sine with n entries a period. 0 for fewer
/// than five.
double sampling_error(const std::vector<Vec3>& entries);

}  // namespace ddacontact
