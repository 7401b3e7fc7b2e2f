/// \file Which colour stands for which values.
#pragma once

#include <ddacontact/picture/field.hpp>

#include <string>
#include <vector>

namespace ddacontact {

/// From low to high, in the unit of a field.
struct ValueRange {
  double low = 0, high = 0;
  bool operator==(const ValueRange&) const = default;
};

/// Whether a range is below a thousandth of its values: in colours it would look like extremes. Of fields
/// with a sign below a fiftieth: their colours are symmetric about zero and would all be the darkest.
bool is_one_value(const ValueRange& range, Field field);

/// Bands of equal height; those of signed fields lie about round values, so that zero has one, others between
/// them.
class ColourScale {
 public:
  /// Covers the range of the data, or `shown` where that is given: then values beyond it take the colour of
  /// the nearest end. Signed fields get colours symmetric about zero. Data that are one value get one
  /// band.
  /// \param[in] note  how `shown` was chosen, for the reader; may be empty
  ColourScale(Field field, const ValueRange& data, const ValueRange* shown = nullptr, std::string note = {});

  Field field() const { return field_; }
  /// Whether there is but one value, `bounds()[0]`, and one band.
  bool is_constant() const { return bounds_.size() == 1; }
  /// Between the bands, ascending, and at both ends: n_bands() + 1 values.
  const std::vector<double>& bounds() const { return bounds_; }
  int n_bands() const { return is_constant() ? 1 : static_cast<int>(bounds_.size()) - 1; }
  /// The band a value lies in, 0 .. n_bands() - 1.
  int band(double value) const;
  Colour colour(int band) const;
  /// Whether the data go on below, above the bands.
  bool cut_below() const { return !is_constant() && data_.low < bounds_.front(); }
  bool cut_above() const { return !is_constant() && data_.high > bounds_.back(); }

  const ValueRange& data() const { return data_; }
  const std::string& note() const { return note_; }

  bool operator==(const ColourScale&) const = default;

 private:
  Field field_;
  ValueRange data_;
  std::vector<double> bounds_;
  std::string note_;
};

}  // namespace ddacontact
