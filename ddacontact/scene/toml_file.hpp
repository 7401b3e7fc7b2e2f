/// \file Text to a TOML tree, and where its nodes stand.
#pragma once

#include <ddacontact/scene/problem_list.hpp>

#include <toml++/toml.h>

#include <optional>
#include <string>

namespace ddacontact::scene_format {

/// The tree of a text; nothing and one problem when it is not TOML: a syntax error, a duplicate key, bytes
/// that are not UTF-8, nesting beyond what a scene can need.
std::optional<toml::table> parse_toml(const std::string& text, const std::string& source,
                                      ProblemList& problems);

/// Where a value stands. A value that a setting replaced, or an array that one changed, is placed in the
/// setting.
SourceLocation location_of(const toml::node& node, const ProblemList& problems);
SourceLocation location_of(const toml::key& key, const ProblemList& problems);

/// A number, string or boolean as it is written, at most 40 characters; empty for other values.
std::string literal_of(const toml::node& node);

/// A value in words, for messages: "the string 'abc'", "an array".
std::string description_of(const toml::node& node);

}  // namespace ddacontact::scene_format
