/// \file JSON text to a tree.
#pragma once

#include <ddacontact/scene/json_tree.hpp>

#include <memory>
#include <optional>
#include <string>

namespace ddacontact::scene_format {

/// Nothing and one problem when `text` is not JSON, repeats a key in an object, or is nested more than 64
/// deep.
std::optional<JsonTree> parse_json(const std::string& text, std::shared_ptr<const std::string> source,
                                   ProblemList& problems);

}  // namespace ddacontact::scene_format
