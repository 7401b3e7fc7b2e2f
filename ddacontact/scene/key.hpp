/// \file The declaration of one key of the scene format.
#pragma once

#include <limits>
#include <string>

namespace ddacontact::scene_format {

/// What a number may be. Numbers beyond `largest_number` are refused everywhere, and where 0 is too small,
/// those below `smallest_positive` are.
struct Bounds {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool with_low = true, with_high = true;  ///< whether the bound itself is allowed

  bool contain(double value) const {
    return (with_low ? value >= low : value > low) && (with_high ? value <= high : value < high);
  }
  /// "> 0", ">= 0 and < 0.5"; empty when anything is allowed.
  std::string text() const;
};

/// Keeps areas, moments and their products finite.
inline constexpr double largest_number = 1e60;
/// What must be positive is at least this, for the same reason.
inline constexpr double smallest_positive = 1e-30;

inline constexpr Bounds positive{.low = 0, .with_low = false};
inline constexpr Bounds not_negative{.low = 0};
inline constexpr Bounds at_least_one{.low = 1};

/// One key. Its type and its default are those of the member it is visited with, see schema.hpp.
struct Key {
  const char* name;
  const char* what;             ///< one sentence for the documentation
  const char* unit = "";        ///< SI unit of a plain number; empty for a dimensionless one
  const char* other_unit = "";  ///< accepted as well, one for one (thickness 1 m)
  Bounds bounds = {};
  bool required = false;
  const char* default_text = nullptr;  ///< what the documentation says when the default is no constant
};

/// Stands for the value of a key of [analysis] that no stage may change.
struct OfTheWholeRun {};
/// Stands for the value of a key of a joint that only a stage may write.
struct OfStages {};

}  // namespace ddacontact::scene_format
