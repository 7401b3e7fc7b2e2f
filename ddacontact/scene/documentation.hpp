/// \file The key tables of the documentation, from the declarations of the keys.
#pragma once

#include <string>

namespace ddacontact::scene_format {

/// A Markdown table of the keys of a table ("analysis", "block", ...), or of the top of the file for "".
/// Empty for an unknown name.
std::string key_table(const std::string& table);

}  // namespace ddacontact::scene_format
