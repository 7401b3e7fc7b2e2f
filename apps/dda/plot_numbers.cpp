#include "plot_numbers.hpp"

#include "call_error.hpp"

#include <fmt/format.h>
#include <ddacontact/scene/spelling.hpp>
#include <ddacontact/scene/units.hpp>

#include <charconv>
#include <cmath>

namespace dda {

using namespace ddacontact;

namespace {

std::vector<std::string> parts(const std::string& text) {
  std::vector<std::string> words(1);
  for (const char c : text) {
    if (c == ',')
      words.emplace_back();
    else
      words.back() += c;
  }
  return words;
}

double number(const std::string& option, const std::string& text, const char* unit) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [read, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc() && read == end && std::isfinite(value)) return value;
  const scene_format::QuantityReading reading = scene_format::read_quantity(text, unit, "");
  if (reading.error.empty()) return reading.value;
  throw CallError(fmt::format("{}: \"{}\" {}", option, scene_format::excerpt(text), reading.error));
}

/// The numbers of "1,2 kPa,...": so many, each may have its unit.
std::vector<double> numbers(const std::string& option, const std::string& text, std::size_t count,
                            const char* unit) {
  const std::vector<std::string> words = parts(text);
  if (words.size() != count)
    throw CallError(fmt::format("{} takes {} numbers with commas between them, not \"{}\"", option, count,
                                scene_format::excerpt(text)));
  std::vector<double> values;
  for (const std::string& word : words) values.push_back(number(option, word, unit));
  return values;
}

/// That of the largest numbers overflows.
void expect_width(double low, double high, const char* option) {
  if (!std::isfinite(high - low))
    throw CallError(
        fmt::format("{}: {:.4g} to {:.4g} is too wide (give smaller numbers)", option, low, high));
}

}  // namespace

std::vector<std::string> single_words(const std::vector<std::string>& lists) {
  std::vector<std::string> words;
  for (const std::string& list : lists)
    for (std::string& word : parts(list)) words.push_back(std::move(word));
  return words;
}

ValueRange colour_range(const std::string& text, const std::vector<Field>& fields) {
  const std::string unit = description(fields.front()).unit;
  for (const Field field : fields)
    if (unit.empty() || unit != description(field).unit)
      throw CallError("--range needs fields of numbers, all of one unit");
  const std::vector<double> ends = numbers("--range", text, 2, unit.c_str());
  if (!(ends[0] < ends[1])) throw CallError("--range: the first number must be below the second");
  expect_width(ends[0], ends[1], "--range");
  return {ends[0], ends[1]};
}

Window window(const std::string& text) {
  const std::vector<double> sides = numbers("--window", text, 4, "m");
  if (!(sides[0] < sides[1] && sides[2] < sides[3]))
    throw CallError("--window: give XMIN,XMAX,YMIN,YMAX with each minimum below its maximum");
  expect_width(sides[0], sides[1], "--window");
  expect_width(sides[2], sides[3], "--window");
  return {{sides[0], sides[2]}, {sides[1], sides[3]}};
}

}  // namespace dda
