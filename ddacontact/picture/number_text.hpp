/// \file Numbers as people read them: few digits, a prefix before the unit, ticks at round values.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ddacontact {

/// "k" for 1e3: `factor` of the unit is one of the prefixed unit.
struct Prefix {
  std::string symbol;
  double factor = 1;
};

/// The prefix with which a number of this magnitude has one to three digits before the point: n, micro, m, k,
/// M, G for any unit, up to k only for "m", none above 1 for "s", and 0.1 to 1 of both as it is; none for no
/// unit and for zero.
Prefix prefix_of(double magnitude, std::string_view unit);

/// `digits` significant ones, trailing zeros left out, a proper minus sign; powers of ten for numbers of more
/// than seven digits before or three zeros behind the point. Not finite: "undefined".
std::string number_text(double value, int digits);

/// "3.42 MPa".
std::string quantity_text(double value, std::string_view unit, int digits = 3);

/// 1, 2, 2.5 or 5 times a power of ten: the smallest with at most `most` steps in `length` > 0.
double round_step(double length, int most);

/// The largest 1, 2 or 5 times a power of ten that is at most `limit` > 0.
double round_below(double limit);

/// Where an axis is marked.
struct Ticks {
  double step = 1;
  std::vector<double> values;  ///< multiples of the step within the range, ends included
};

/// At most `most` + 1 ticks in low < high.
Ticks ticks_between(double low, double high, int most);

/// Where a logarithmic axis is marked from low to high, 0 < low < high: at powers of ten, every second, third
/// ... one when there would be more than `most`; where there are less than three, at 2 and 5 times them as
/// well.
std::vector<double> logarithmic_ticks(double low, double high, int most);

/// A digit times a power of ten as on a logarithmic axis: "10⁻³", "2×10⁴", and "1", "20", "0.5" near one.
std::string decade_text(double value);

/// A multiple of `step`, with the digits the step needs.
std::string tick_text(double value, double step);

}  // namespace ddacontact
