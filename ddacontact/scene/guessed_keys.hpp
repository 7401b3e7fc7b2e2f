/// \file Keys that users of other programs guess, and what a scene says instead.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ddacontact::scene_format {

/// The cure for a key that does not exist but is often guessed: what to write instead, or that this version
/// has no such thing. Empty: the key is not among those.
/// \param[in] key    as written; capitals count as small letters
/// \param[in] table  where it stands, as messages call it: "[contact]", "[[joint]]", "the scene"
std::string_view cure_of_guessed_key(std::string_view key, std::string_view table);

/// That cure, else the tables that have a key of that name, else the nearest of the keys that the table has.
std::string cure_of_unknown_key(std::string_view key, std::string_view table,
                                const std::vector<std::string_view>& known);

}  // namespace ddacontact::scene_format
