/// \file Blocks as they are: outlines, plain colours, names.
#pragma once

#include <ddacontact/picture/field.hpp>
#include <ddacontact/picture/view.hpp>

#include <string>
#include <vector>

namespace ddacontact {

/// The colour of each block by `Field::material` or `Field::block`.
void draw_kinds(SvgPage& page, const View& view, const Frame& frame, Field field);

/// Every block in one pale colour, to tell blocks from gaps.
void draw_fill(SvgPage& page, const View& view, const Frame& frame);

/// Thinner where blocks are small on the page.
void draw_outlines(SvgPage& page, const View& view, const Frame& frame);

/// Between the cells of blocks that have several, pale; not where cells are small on the page.
void draw_cell_edges(SvgPage& page, const View& view, const Frame& frame);

/// Where the blocks were at the start, dashed. The frame must hold displacements.
void draw_reference(SvgPage& page, const View& view, const Frame& frame);

/// At the middles, where they fit; a block without a name is called by its index.
void draw_names(SvgPage& page, const View& view, const Frame& frame, const std::vector<std::string>& names);

/// The centroid of a block's current outline, or where that is outside a point inside.
Vec2 middle(const Frame& frame, int block);

}  // namespace ddacontact
