/// \file Copies of a block in a grid.
#pragma once

#include <ddacontact/scene/records.hpp>

namespace ddacontact::scene_format {

/// Puts the copies in the place of blocks with a `grid`: NAME.0.0, NAME.1.0, ..., row by row from below.
void add_copies(Document& document, ProblemList& problems);

}  // namespace ddacontact::scene_format
