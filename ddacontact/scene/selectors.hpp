/// \file Blocks, vertices and edges named by where they are or by their group.
#pragma once

#include <ddacontact/scene/records.hpp>

#include <vector>

namespace ddacontact::scene_format {

/// Vertices lie on a line within this times the size of their block.
inline constexpr double on_line = 1e-6;

/// Puts in the place of each support, load and monitor with selectors one for each block (and edge) that they
/// find, and blocks in the place of selectors in lists. A monitor of several blocks becomes NAME.BLOCK. A
/// selector that finds nothing is a problem that says what is near.
void expand_selectors(Document& document, ProblemList& problems);

/// The blocks that a selector finds, ascending.
std::vector<int> find_blocks(const BlockSelector& selector, const Document& document,
                             const SourceLocation& location, ProblemList& problems);

}  // namespace ddacontact::scene_format
