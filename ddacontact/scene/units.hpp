/// \file Quantities written with their unit: "35 MPa", "21 kN/m3", "5 cm", "30 deg".
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace ddacontact::scene_format {

/// A unit: its dimension, and what it is in m, kg, s and rad.
struct Unit {
  int length = 0, mass = 0, time = 0, angle = 0;  ///< exponents
  int decade = 0;                                 ///< power of ten
  double factor = 1;                              ///< the rest (degrees)

  bool same_dimension(const Unit& other) const {
    return length == other.length && mass == other.mass && time == other.time && angle == other.angle;
  }
};

/// Symbols m g t s N Pa J Hz Gal gal rad deg (and the degree sign), with a prefix k M G m c where that makes sense,
/// an exponent of one digit ("m3", "m^3", "s-2"), and between them '/', '*', '.' or a space, taken from left
/// to right; "1/s" too. Nothing for anything else.
std::optional<Unit> parse_unit(std::string_view text);

struct QuantityReading {
  double value = 0;
  std::string error;  ///< what is wrong with it; empty when nothing is
};

/// The number of `text` in `unit`. `other_unit` (may be empty) is accepted too, one of it being one `unit`:
/// with the thickness of 1 m a force per metre may be written as a force.
QuantityReading read_quantity(std::string_view text, std::string_view unit, std::string_view other_unit);

}  // namespace ddacontact::scene_format
