#include "call_error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ddacontact/scene/spelling.hpp>

namespace dda {

std::string choice_among(std::string_view word, const std::vector<std::string_view>& known) {
  const int nearest = ddacontact::scene_format::nearest(word, known);
  return fmt::format("did you mean \"{}\"? there are: {}", known[nearest], fmt::join(known, ", "));
}

}  // namespace dda
