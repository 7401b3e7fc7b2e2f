/// \file The known word nearest to one that is not known.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ddacontact::scene_format {

/// Edits (a character added, left out, replaced, or two neighbours swapped) between two words, capitals
/// counting as small letters. Words are cut to 64 characters.
int edit_distance(std::string_view a, std::string_view b);

/// The position of the known word with the fewest edits (the first of several), where a word that is a part
/// of the other counts as two at most; -1 when none is known.
int nearest(std::string_view word, const std::vector<std::string_view>& known);

/// Whether a word may have been meant to be the known one.
bool is_near(std::string_view word, std::string_view known);

/// A cure for an unknown word: "did you mean 'young'?" when one is near, else the nearest and all that are
/// known of this `kind` ("key", "material", ...), unless they are many.
std::string suggestion(std::string_view word, std::string_view kind,
                       const std::vector<std::string_view>& known);

/// At most 40 characters of text that came from a file, cut at the end of a UTF-8 character.
std::string excerpt(std::string_view text);

}  // namespace ddacontact::scene_format
