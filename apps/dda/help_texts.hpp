/// \file The topics of `dda help` that are prose.
#pragma once

#include <string_view>
#include <vector>

namespace dda {

struct HelpText {
  std::string_view topic;
  std::string_view text;
};

const std::vector<HelpText>& help_texts();

}  // namespace dda
