/// \file A TOML tree to the tables of a scene.
#pragma once

#include <ddacontact/scene/records.hpp>

#include <toml++/toml.h>

namespace ddacontact::scene_format {

/// Reads every table; what is wrong with single values, unknown and missing keys goes to `problems`.
Document read_document(const toml::table& root, ProblemList& problems);

}  // namespace ddacontact::scene_format
