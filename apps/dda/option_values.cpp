#include "option_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace dda {

namespace {

/// "from 1 to 9"; `link` is what a sentence puts before `text`, as --help has it.
struct Bounds {
  const char* link;
  std::string text;
};

template <typename Number>
Bounds range(Number least, Number most) {
  return {" from ", fmt::format("{} to {}", least, most)};
}

/// The option takes a `kind` of number from `least` to `most`, which `bounds` tells.
template <typename Number>
CLI::Option* expect(CLI::Option* option, const char* type, const char* kind, Number least, Number most,
                    const Bounds& bounds) {
  const std::string what = fmt::format("takes {}{}{}", kind, bounds.link, bounds.text);
  option->description(fmt::format("{}; {}", option->get_description(), bounds.text))->type_name(type);
  return option->check(
      [=](const std::string& word) {
        Number value{};
        const bool is_one = CLI::detail::lexical_cast(word, value) && value >= least && value <= most;
        return is_one ? std::string() : fmt::format("{}, not \"{}\"", what, word);
      },
      "");
}

}  // namespace

CLI::Option* expect_whole_number(CLI::Option* option, std::int64_t least, std::int64_t most) {
  const bool has_most = most < std::numeric_limits<int>::max();
  return expect(option, "N", "a whole number", least, most,
                has_most ? range(least, most) : Bounds{", ", fmt::format("{} or more", least)});
}

CLI::Option* expect_number(CLI::Option* option, double least, double most) {
  return expect(option, "X", "a number", least, most, range(least, most));
}

CLI::Option* expect_positive_number(CLI::Option* option) {
  return expect(option, "X", "a number", std::numeric_limits<double>::min(),
                std::numeric_limits<double>::max(), {" ", "above 0"});
}

CLI::Option* expect_word(CLI::Option* option, const std::vector<std::string>& words) {
  option->type_name("WORD");
  return option->check(
      [words](const std::string& word) {
        return std::ranges::find(words, word) != words.end()
                   ? std::string()
                   : fmt::format("takes {}, not \"{}\"", fmt::join(words, " or "), word);
      },
      "");
}

}  // namespace dda
