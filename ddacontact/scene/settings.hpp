/// \file Settings from the command line, put into the tree of a scene file before it is read.
#pragma once

#include <ddacontact/scene/problem_list.hpp>

#include <toml++/toml.h>

#include <string>
#include <vector>

namespace ddacontact::scene_format {

/// Each setting is PATH=VALUE. PATH is KEY, TABLE.KEY or TABLES.ELEMENT.KEY, followed by indices into the
/// value; ELEMENT is a name or an index, a part with dots stands in double quotes. VALUE is TOML, or else a
/// string. The new values' source is "--set PATH=VALUE", so that problems with them name it. Blocks of a
/// geometry file are not in the tree: a setting for one is a problem that says so.
void apply_settings(const std::vector<std::string>& settings, toml::table& root, ProblemList& problems);

}  // namespace ddacontact::scene_format
