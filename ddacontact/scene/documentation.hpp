/// \file The key tables of the documentation, from the declarations of the keys.
#pragma once

#include <string>
#include <vector>

namespace ddacontact::scene_format {

/// What the documentation says of a key.
struct KeyRow {
  std::string name;
  std::string value;         ///< type, unit and bounds
  std::string default_text;  ///< Markdown; "required" where there is none
  std::string what;          ///< one sentence
};

/// The keys of a table ("analysis", "block", "domain.joint_set", ...), or of the top of the file for "". None
/// for an unknown name.
std::vector<KeyRow> key_rows(const std::string& table);

/// A Markdown table of the keys of a table ("analysis", "block", ...), or of the top of the file for "".
/// Empty for an unknown name.
std::string key_table(const std::string& table);

}  // namespace ddacontact::scene_format
