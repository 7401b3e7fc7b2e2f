/// \file The text of a file, or why it cannot be read.
#pragma once

#include <optional>
#include <string>

namespace ddacontact::scene_format {

struct FileText {
  std::optional<std::string> text;
  std::string reason;  ///< without a text: what the system says
};

FileText read_text(const std::string& path);

}  // namespace ddacontact::scene_format
