/// \file Numbers and strings as a scene file spells them.
#pragma once

#include <string>
#include <string_view>

namespace ddacontact::scene_format {

/// The shortest text that reads back to the same double; always a TOML float ("2.0", "1e-06").
std::string number_text(double value);

/// The shortest text, without an added ".0": for messages.
std::string short_number(double value);

/// Four significant digits: for what was measured, in messages.
std::string rounded(double value);

/// A TOML basic string with its quotes; valid UTF-8 stays valid.
std::string quoted(std::string_view text);

}  // namespace ddacontact::scene_format
