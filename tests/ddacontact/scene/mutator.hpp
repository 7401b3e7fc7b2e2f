/// \file Texts with a few changes at random, of the kinds that break readers.
#pragma once

#include <algorithm>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace support {

/// Divided by |.
inline constexpr std::string_view all_tokens =
    "nan|inf|-inf|-1|0|1e308|-1e308|1e-308|5e-324|1e400|1e60|1e-30|1e150|-0.0|0x7fffffff|2147483647|"
    "2147483648|-9223372036854775808|9223372036854775807|99999999999999999999|true|[]|[[]]|{}|\"\"|"
    "\"5 cm\"|\"1 kN\"|\"1e308 MPa\"|\"1e-308 mm\"|\"nan Pa\"|\"auto\"|\"mean_value\"|\"mesh\"|"
    "\"wachspress\"|\"quads\"|{ cells = 1000000 }|{ cell_size = 1e-30 }|1979-05-27|12:00:00|[0, 0]|"
    "[[0, 0]]|[nan, 1]|\"centroid\"|\"\\u0000\"|'''|\"\"\"|#|[[|]]|=|.|a.b.c|\xff|\xed\xa0\x80|"
    "\xf4\x90\x80\x80|\n|\r|\t| |null|{\"a\": 1}|{|}|(|)|EMPTY|POLYGON|GEOMETRYCOLLECTION|SRID=1;|"
    "[\"pillar\"]|{ interface = { cohesion = 1 } }|[[stage]]|steps|\"Polygon\"|\"Feature\"";

inline const std::vector<std::string>& tokens() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> parts(1);
    for (const char c : all_tokens) {
      if (c == '|')
        parts.emplace_back();
      else
        parts.back() += c;
    }
    return parts;
  }();
  return all;
}

class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  std::string operator()(std::string text) {
    const std::size_t changes = 1 + below(3);
    for (std::size_t i = 0; i < changes && !text.empty(); ++i) change(text);
    return text;
  }

  std::size_t below(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_); }

 private:
  void change(std::string& text) {
    const std::size_t location = below(text.size());
    switch (below(14)) {
      case 0:
        text[location] = static_cast<char>(below(256));
        break;
      case 1:
        text[location] = static_cast<char>(text[location] ^ (1 << below(8)));
        break;
      case 2:
        text.erase(location, 1 + below(20));
        break;
      case 3:
        text.resize(location);
        break;
      case 4:
        text.insert(location, tokens()[below(tokens().size())]);
        break;
      case 5:
        swap_lines(text, location);
        break;
      case 6:
        repeat_line(text, location);
        break;
      case 7:
        text.erase(line_begin(text, location), line_end(text, location) - line_begin(text, location));
        break;
      case 8:
      case 9:
      case 10:
        replace_token(text, location);
        break;
      default:
        change_digit(text, location);
    }
  }
  static std::size_t line_begin(const std::string& text, std::size_t location) {
    return location == 0 ? 0 : text.rfind('\n', location - 1) + 1;
  }
  static std::size_t line_end(const std::string& text, std::size_t location) {
    return std::min(text.find('\n', location), text.size() - 1) + 1;
  }
  void repeat_line(std::string& text, std::size_t location) {
    const std::string line =
        text.substr(line_begin(text, location), line_end(text, location) - line_begin(text, location));
    text.insert(line_begin(text, below(text.size())), line);
  }
  void swap_lines(std::string& text, std::size_t location) {
    const std::size_t begin = line_begin(text, location), end = line_end(text, location);
    const std::string line = text.substr(begin, end - begin);
    text.erase(begin, end - begin);
    if (text.empty()) return;
    text.insert(line_begin(text, below(text.size())), line);
  }
  /// A whole word or number becomes a nasty one, or the value of another place.
  void replace_token(std::string& text, std::size_t location) {
    static const char* const separators = " \t\n,[]{}=\"'.";
    const std::size_t begin = std::min(text.find_first_not_of(separators, location), text.size());
    const std::size_t end = std::min(text.find_first_of(" \t\n,[]{}=\"'", begin), text.size());
    text.replace(begin, end - begin, tokens()[below(tokens().size())]);
  }

  /// Keeps the syntax, so that what comes after it is tried too.
  void change_digit(std::string& text, std::size_t location) {
    const std::size_t digit = text.find_first_of("0123456789", location);
    if (digit != std::string::npos) text[digit] = static_cast<char>('0' + below(10));
  }

  std::mt19937 random_;
};

}  // namespace support
