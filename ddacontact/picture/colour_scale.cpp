#include <ddacontact/picture/colour_scale.hpp>

#include <ddacontact/picture/number_text.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

namespace {

constexpr int most_bands = 60;
/// Ranges narrower than this, relative to the values, are one value.
constexpr double least_range = 1e-3, least_range_with_sign = 0.02;
constexpr double slack = 1e-6;  // of a band

}  // namespace

bool is_one_value(const ValueRange& range, Field field) {
  const double least = description(field).kind == FieldKind::with_sign ? least_range_with_sign : least_range;
  return !(range.high - range.low > least * std::max(std::abs(range.low), std::abs(range.high)));
}

ColourScale::ColourScale(Field field, const ValueRange& data, const ValueRange* shown, std::string note)
    : field_(field), data_(data), note_(std::move(note)) {
  const ValueRange& range = shown != nullptr ? *shown : data;
  if (shown == nullptr ? is_one_value(range, field) : !(range.low < range.high)) {
    bounds_ = {range.low};
    return;
  }
  const double step = round_step(range.high - range.low, most_bands);
  const double shift = description(field).kind == FieldKind::with_sign ? 0.5 : 0;
  const double first = std::floor(range.low / step - shift + slack);
  const double last = std::ceil(range.high / step - shift - slack);
  // Counted from 0: beyond 2^53 adding 1 changes nothing.
  for (int k = 0; k <= last - first; ++k) bounds_.push_back((first + k + shift) * step);
  if (shown == nullptr) return;
  bounds_.front() = range.low;
  bounds_.back() = range.high;
}

int ColourScale::band(double value) const {
  const auto above = std::upper_bound(bounds_.begin(), bounds_.end(), value);
  return std::clamp(static_cast<int>(above - bounds_.begin()) - 1, 0, n_bands() - 1);
}

Colour ColourScale::colour(int band) const {
  const bool with_sign = description(field_).kind == FieldKind::with_sign;
  if (is_constant()) {
    if (!with_sign) return sequential_colour(bounds_[0] == 0 ? 0 : 0.25);
    return diverging_colour(bounds_[0] == 0 ? 0 : std::copysign(0.5, bounds_[0]));
  }
  const auto k = static_cast<std::size_t>(band);
  const double middle = (bounds_[k] + bounds_[k + 1]) / 2, low = bounds_.front(), high = bounds_.back();
  if (with_sign) return diverging_colour(middle / std::max(std::abs(low), std::abs(high)));
  return sequential_colour((middle - low) / (high - low));
}

}  // namespace ddacontact
