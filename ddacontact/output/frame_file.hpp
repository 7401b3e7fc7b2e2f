/// \file A frame as two files for ParaView: its blocks and its contacts.
#pragma once

#include <ddacontact/output/frame_options.hpp>

#include <filesystem>

namespace ddacontact {

/// The cells of blocks as polygons or sub-triangles. Point and cell arrays: `block_id`, `material` and, as
/// `options` ask, `displacement`, `velocity`, `sxx`, `syy`, `sxy`, `s1`, `s2`. Field data and the point array
/// `strain_displacement` hold what else makes the frame; of blocks that are one cell of Wachspress functions
/// nothing of cells. Throws OutputError.
void write_blocks(const std::filesystem::path& path, const Frame& frame, const FrameOptions& options);

/// Contacts as points at the vertex. Point arrays: `normal_force`, `shear_force` along the normal turned
/// left, `gap`, `state` (0 open, 1 stick, 2 slip), `slip_sense` (1 when the vertex slides that way too, -1
/// when against it, 0 when it does not), `force` on `block_a`, whose vertex it is, `normal` out of `block_b`,
/// whose edge it is. Throws OutputError.
void write_contacts(const std::filesystem::path& path, const Frame& frame);

}  // namespace ddacontact
