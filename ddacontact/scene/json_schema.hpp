/// \file The scene format as a JSON schema, for editors, from the declarations of the keys.
#pragma once

#include <string>

namespace ddacontact::scene_format {

/// JSON Schema, draft 2020-12, of a scene file as a JSON or TOML document. It names every table and key, with
/// the types, words and bounds of values; a number may also be a string with a unit. What it refuses the
/// reader refuses too, not the other way around: the reader also knows units, names and geometry.
std::string json_schema();

}  // namespace ddacontact::scene_format
