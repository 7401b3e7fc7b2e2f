/// \file One random slope: the friction that could hold it, and what it does with less and with more.
#pragma once

#include "sudden_weight.hpp"

#include <tests/support/random_slopes.hpp>

#include <optional>
#include <string>
#include <vector>

namespace jointed_rock {

constexpr double gravity = 9.8;       ///< m/s2
constexpr double below_limit = 0.97;  ///< of the limiting tan(phi): has to move
constexpr double above_limit = 1.1;   ///< of the limiting tan(phi): may rest or not
/// Of the larger of the limit and the steepest dip, both as tangents: has to rest. Not tried above 80
/// degrees.
constexpr double above_both = 1.2;

double degrees(double tangent);
/// By which a single block slides down a plane of the limiting angle with `below_limit` of its tangent, m/s2.
double least_acceleration(double limit);

/// A slope that some friction holds and less does not.
struct Slope {
  std::uint64_t seed = 0;
  Scene scene;
  int n_free = 0;
  double limit = 0;     ///< tan(phi)
  double steepest = 0;  ///< tan of the steepest dip
};

/// Those of the seeds from 0 on that have a limit.
class Slopes {
 public:
  explicit Slopes(const support::SlopeSize& size) : size_(size) {}
  Slope next();
  int n_never_held() const { return n_never_held_; }  ///< seeds so far that no friction holds

 private:
  support::SlopeSize size_;
  std::uint64_t seed_ = 0;
  int n_never_held_ = 0;
};

/// A verdict, and the displacement over that by `least_acceleration`.
struct Seen {
  Verdict verdict = Verdict::stops;
  double part = 0;
};

/// The slope mirrored, and with blocks and vertices numbered otherwise, against the slope as it is.
struct Restated {
  bool same_verdict = true;
  double apart = 0;  ///< largest difference of displacements, over the largest displacement
};

struct SlopeResult {
  std::uint64_t seed = 0;
  int n_free = 0;
  double limit = 0, steepest = 0;
  Seen below;                        ///< `below_limit`
  std::optional<Restated> restated;  ///< of `below`
  Seen above;                        ///< `above_limit`
  std::optional<Seen> rough;         ///< `above_both`
};

SlopeResult study(const Slope& slope, bool with_restated);

/// A line of a record, and back. Throws Error when it is none.
std::string record_line(const SlopeResult& result);
SlopeResult read_record_line(const std::string& line);

}  // namespace jointed_rock
