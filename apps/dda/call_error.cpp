#include "call_error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ddacontact/scene/spelling.hpp>

namespace dda {

std::string choice_among(std::string_view word, const std::vector<std::string_view>& known) {
  const std::string_view nearest = known[ddacontact::scene_format::nearest(word, known)];
  return fmt::format(
      "{}there are: {}",
      ddacontact::scene_format::is_near(word, nearest) ? fmt::format("did you mean \"{}\"? ", nearest) : "",
      fmt::join(known, ", "));
}

}  // namespace dda
