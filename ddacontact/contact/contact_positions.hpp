/// \file Where the vertex and the edge of a contact are in a state, and what is rounded there.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/contact/contact.hpp>

namespace ddacontact {

/// From the origin of the edge's block.
RoundedPositions positions_of(const BlockSystem& blocks, const BlockState& state, const VertexEdge& pair);

/// The pair in motion from a state on.
MovingVertexEdge motion_of(const BlockSystem& blocks, const BlockState& state, const VertexEdge& pair);

}  // namespace ddacontact
