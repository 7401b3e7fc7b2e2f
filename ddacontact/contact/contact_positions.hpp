/// \file Where the vertex and the edge of a contact are in a state, and what is rounded there.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/contact/contact.hpp>

namespace ddacontact {

/// From the origin of the edge's block.
RoundedPositions positions_of(const BlockSystem& blocks, const BlockState& state, const VertexEdge& pair);

/// The pair in motion from a state on. \param[in] inset  how far from a sharp vertex its forces act, along
/// that edge beside it which lies closest to the other block's, m
MovingVertexEdge motion_of(const BlockSystem& blocks, const BlockState& state, const VertexEdge& pair,
                           double inset = 0);

}  // namespace ddacontact
