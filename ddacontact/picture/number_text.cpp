#include <ddacontact/picture/number_text.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace ddacontact {

namespace {

constexpr const char* minus = "\u2212";

double power_of_ten(int exponent) {
  return std::pow(10., exponent);
}

/// The exponent of the first digit of a number > 0, as it is printed with `digits` digits.
int decimal_exponent(double value, int digits) {
  std::array<char, 64> text{};
  std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific, digits - 1);
  const std::string_view printed(text.data());
  return std::atoi(printed.substr(printed.find('e') + 1).data());
}

std::string fixed(double magnitude, int decimals) {
  std::array<char, 400> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), magnitude, std::chars_format::fixed, decimals)
          .ptr;
  return {text.data(), end};
}

void drop_trailing_zeros(std::string& text) {
  if (text.find('.') == std::string::npos) return;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
}

std::string superscript(int exponent) {
  constexpr std::array<const char*, 10> digits = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                                  "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  std::string text = exponent < 0 ? "\u207b" : "";
  for (const char c : std::to_string(std::abs(exponent))) text += digits[static_cast<std::size_t>(c - '0')];
  return text;
}

std::string signed_text(double value, const std::string& magnitude) {
  const bool zero = magnitude.find_first_of("123456789") == std::string::npos;
  return value < 0 && !zero ? minus + magnitude : magnitude;
}

std::string with_power(double value, int exponent, int digits) {
  std::string mantissa = fixed(std::abs(value) / power_of_ten(exponent), digits - 1);
  drop_trailing_zeros(mantissa);
  return signed_text(value, mantissa) + "\u00d710" + superscript(exponent);
}

}  // namespace

Prefix prefix_of(double magnitude, std::string_view unit) {
  constexpr std::array<const char*, 7> symbols = {"n", "\u00b5", "m", "", "k", "M", "G"};
  if (unit.empty() || !(magnitude > 0) || !std::isfinite(magnitude)) return {};
  const int exponent = decimal_exponent(magnitude, 3);
  int third = exponent >= 0 ? exponent / 3 : -((2 - exponent) / 3);
  const int highest = unit.front() == 's' ? 0 : unit.front() == 'm' ? 1 : 3;
  if (exponent == -1 && highest < 3) third = 0;
  third = std::clamp(third, -3, highest);
  return {symbols[static_cast<std::size_t>(third + 3)], power_of_ten(3 * third)};
}

std::string number_text(double value, int digits) {
  if (!std::isfinite(value)) return "undefined";
  if (value == 0) return "0";
  const int exponent = decimal_exponent(std::abs(value), digits);
  if (exponent > 6 || exponent < -4) return with_power(value, exponent, digits);
  std::string magnitude = fixed(std::abs(value), std::max(0, digits - 1 - exponent));
  drop_trailing_zeros(magnitude);
  return signed_text(value, magnitude);
}

std::string quantity_text(double value, std::string_view unit, int digits) {
  const Prefix prefix = prefix_of(std::abs(value), unit);
  std::string text = number_text(value / prefix.factor, digits);
  if (!unit.empty()) text += " " + prefix.symbol + std::string(unit);
  return text;
}

double round_step(double length, int most) {
  const double least = length / most;
  const double decade = power_of_ten(static_cast<int>(std::floor(std::log10(least))));
  for (const double multiple : {1., 2., 2.5, 5.})
    if (multiple * decade * most >= length * (1 - 1e-9)) return multiple * decade;
  return 10 * decade;
}

double round_below(double limit) {
  const double decade = power_of_ten(static_cast<int>(std::floor(std::log10(limit))));
  for (const double multiple : {10., 5., 2.})
    if (multiple * decade <= limit * (1 + 1e-9)) return multiple * decade;
  return decade;
}

Ticks ticks_between(double low, double high, int most) {
  Ticks ticks;
  ticks.step = round_step(high - low, most);
  if (!std::isfinite(high - low)) return ticks;
  const double slack = 1e-6;
  const double first = std::ceil(low / ticks.step - slack), last = std::floor(high / ticks.step + slack);
  // Counted from 0: beyond 2^53 adding 1 changes nothing.
  for (int k = 0; k <= std::min<double>(last - first, most); ++k)
    ticks.values.push_back((first + k) * ticks.step + 0.);
  return ticks;
}

std::vector<double> logarithmic_ticks(double low, double high, int most) {
  const double slack = 1e-9;
  const int first = static_cast<int>(std::ceil(std::log10(low) - slack));
  const int last = static_cast<int>(std::floor(std::log10(high) + slack));
  std::vector<double> ticks;
  if (last - first < 2) {
    for (int exponent = first - 1; exponent <= last; ++exponent)
      for (const double digit : {1., 2., 5.}) {
        const double tick = digit * power_of_ten(exponent);
        if (tick >= low * (1 - slack) && tick <= high * (1 + slack)) ticks.push_back(tick);
      }
    return ticks;
  }
  const int step = std::max(1, (last - first + most) / most);
  for (int exponent = first; exponent <= last; ++exponent)
    if (exponent % step == 0) ticks.push_back(power_of_ten(exponent));
  return ticks;
}

std::string decade_text(double value) {
  const int exponent = decimal_exponent(value, 1);
  if (std::abs(exponent) < 2) return number_text(value, 1);
  const std::string digit = fixed(value / power_of_ten(exponent), 0);
  return (digit == "1" ? "" : digit + "\u00d7") + "10" + superscript(exponent);
}

std::string tick_text(double value, double step) {
  const double magnitude = std::abs(value);
  if (magnitude < step / 2) return "0";
  const int first = decimal_exponent(magnitude, 12);
  int last = decimal_exponent(step, 2);  // of the last digit needed
  if (std::abs(step / power_of_ten(last) - 2.5) < 0.01) --last;
  const int digits = std::max(1, first - last + 1);
  if (first > 6 || first < -4) return with_power(value, first, digits);
  return signed_text(value, fixed(magnitude, std::max(0, -last)));
}

}  // namespace ddacontact
