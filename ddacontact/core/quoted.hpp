/// \file A name in a message.
#pragma once

#include <string>

namespace ddacontact {

/// Between quotation marks.
inline std::string quoted(const std::string& name) {
  return "\"" + name + "\"";
}

}  // namespace ddacontact
