/// \file The names of all tables and keys of the scene format.
#pragma once

#include <string_view>
#include <vector>

namespace ddacontact::scene_format {

/// A table, or a key at the top of the file.
struct CatalogEntry {
  enum class Kind { key, table, tables };
  std::string_view name;
  Kind kind = Kind::key;
  std::vector<std::string_view> keys;  ///< of a table
};

const std::vector<CatalogEntry>& catalog();

}  // namespace ddacontact::scene_format
