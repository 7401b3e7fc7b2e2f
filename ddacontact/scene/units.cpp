#include <ddacontact/scene/spelling.hpp>
#include <ddacontact/scene/units.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

namespace ddacontact::scene_format {

namespace {

struct Symbol {
  std::string_view text;
  bool takes_prefix;
  Unit unit;
};

// length, mass, time, angle, decade, factor
constexpr std::array<Symbol, 13> symbols{{
    {"m", true, {1, 0, 0, 0, 0, 1}},
    {"g", true, {0, 1, 0, 0, -3, 1}},
    {"t", false, {0, 1, 0, 0, 3, 1}},
    {"s", true, {0, 0, 1, 0, 0, 1}},
    {"N", true, {1, 1, -2, 0, 0, 1}},
    {"Pa", true, {-1, 1, -2, 0, 0, 1}},
    {"J", true, {2, 1, -2, 0, 0, 1}},
    {"Hz", true, {0, 0, -1, 0, 0, 1}},
    {"Gal", false, {1, 0, -2, 0, -2, 1}},
    {"gal", false, {1, 0, -2, 0, -2, 1}},
    {"rad", true, {0, 0, 0, 1, 0, 1}},
    {"deg", false, {0, 0, 0, 1, 0, std::numbers::pi / 180}},
    {"\u00b0", false, {0, 0, 0, 1, 0, std::numbers::pi / 180}},
}};

struct Prefix {
  char letter;
  int decade;
};
constexpr std::array<Prefix, 5> prefixes{{{'k', 3}, {'M', 6}, {'G', 9}, {'m', -3}, {'c', -2}}};

std::optional<Unit> find_symbol(std::string_view text) {
  for (const Symbol& symbol : symbols)
    if (text == symbol.text) return symbol.unit;
  for (const Symbol& symbol : symbols) {
    if (!symbol.takes_prefix || text.empty() || text.substr(1) != symbol.text) continue;
    for (const Prefix& prefix : prefixes) {
      if (text[0] != prefix.letter) continue;
      Unit unit = symbol.unit;
      unit.decade += prefix.decade;
      return unit;
    }
  }
  return std::nullopt;
}

/// "Gpa": " (did you mean GPa?)"; empty where capitals are not what is wrong.
std::string meant(std::string_view text) {
  for (const Symbol& symbol : symbols) {
    std::vector<std::string> known{std::string(symbol.text)};
    if (symbol.takes_prefix)
      for (const Prefix& prefix : prefixes) known.push_back(prefix.letter + std::string(symbol.text));
    for (const std::string& word : known)
      if (edit_distance(text, word) == 0) return " (did you mean " + word + "?)";
  }
  return "";
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Takes "m", "kN", "m3", "m^3", "s-2" off the front of `text`.
std::optional<Unit> take_factor(std::string_view& text) {
  const auto length = std::min(text.find_first_of("0123456789^-+*/. "), text.size());
  std::optional<Unit> unit = find_symbol(text.substr(0, length));
  if (!unit) return std::nullopt;
  text.remove_prefix(length);
  const bool caret = !text.empty() && text[0] == '^';
  if (caret) text.remove_prefix(1);
  const bool minus = !text.empty() && text[0] == '-';
  if (minus) text.remove_prefix(1);
  int exponent = 1;
  if (!text.empty() && is_digit(text[0])) {
    exponent = text[0] - '0';
    text.remove_prefix(1);
  } else if (caret || minus) {
    return std::nullopt;
  }
  if (minus) exponent = -exponent;
  unit->length *= exponent;
  unit->mass *= exponent;
  unit->time *= exponent;
  unit->angle *= exponent;
  unit->decade *= exponent;
  unit->factor = std::pow(unit->factor, exponent);
  return unit;
}

void multiply(Unit& unit, const Unit& by, int sign) {
  unit.length += sign * by.length;
  unit.mass += sign * by.mass;
  unit.time += sign * by.time;
  unit.angle += sign * by.angle;
  unit.decade += sign * by.decade;
  unit.factor = sign > 0 ? unit.factor * by.factor : unit.factor / by.factor;
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

/// value x 10^decade with one rounding where the power of ten is exact.
double scaled(double value, int decade) {
  return decade < 0 ? value / std::pow(10.0, -decade) : value * std::pow(10.0, decade);
}

/// `unit` when its dimension is that of `text`'s; the factor between the two goes to `value`.
bool convert(const Unit& written, std::string_view unit, double& value) {
  const std::optional<Unit> wanted = unit.empty() ? std::nullopt : parse_unit(unit);
  if (!wanted || !wanted->same_dimension(written)) return false;
  value = scaled(value, written.decade - wanted->decade);
  if (written.factor != wanted->factor) value *= written.factor / wanted->factor;
  return true;
}

}  // namespace

std::optional<Unit> parse_unit(std::string_view text) {
  text = trim(text);
  if (text.empty() || text.size() > 40) return std::nullopt;
  Unit unit;
  int sign = 1;
  if (text.substr(0, 2) == "1/") {
    text.remove_prefix(1);
  } else {
    const std::optional<Unit> first = take_factor(text);
    if (!first) return std::nullopt;
    unit = *first;
  }
  while (!text.empty()) {
    const char separator = text[0];
    if (separator != '/' && separator != '*' && separator != '.' && separator != ' ') return std::nullopt;
    text.remove_prefix(1);
    text = trim(text);
    sign = separator == '/' ? -1 : 1;
    const std::optional<Unit> next = take_factor(text);
    if (!next) return std::nullopt;
    multiply(unit, *next, sign);
  }
  return unit;
}

QuantityReading read_quantity(std::string_view text, std::string_view unit, std::string_view other_unit) {
  QuantityReading reading;
  std::string_view rest = trim(text);
  const bool plus = !rest.empty() && rest.front() == '+';
  if (plus) rest.remove_prefix(1);
  const auto [end, status] = std::from_chars(rest.data(), rest.data() + rest.size(), reading.value);
  if (status == std::errc::invalid_argument || (plus && rest.front() == '-')) {
    reading.error = "does not start with a number";
    return reading;
  }
  if (status != std::errc() || !std::isfinite(reading.value)) {
    reading.error = "is not a finite number";
    return reading;
  }
  const std::string_view symbol = trim(rest.substr(end - rest.data()));
  if (symbol.empty()) {
    reading.error = "is a string without a unit";
    return reading;
  }
  const std::optional<Unit> written = parse_unit(symbol);
  if (!written)
    reading.error = "has the unknown unit '" + excerpt(symbol) + "'" + meant(symbol);
  else if (!convert(*written, unit, reading.value) && !convert(*written, other_unit, reading.value))
    reading.error = "has the wrong unit '" + excerpt(symbol) + "'";
  return reading;
}

}  // namespace ddacontact::scene_format
