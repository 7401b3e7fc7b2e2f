/// \file Where the vertex and the edge of a contact are in a state, and what is rounded there.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/contact/contact.hpp>

namespace ddacontact {

/// Positions of the vertex and the edge of a pair, from the origin of the edge's block.
RoundedPositions positions_of(const BlockSystem& blocks, const BlockState& state, const VertexEdge& pair);

/// The pair in motion from a state on.
/// \param[in] inset  how far from a sharp vertex its forces act, along that edge beside it which lies closest
///                   to the other block's, m
/// \param[in] of_corner  radius of the corner that a rounded vertex meets, m
MovingVertexEdge motion_of(const BlockSystem& blocks, const BlockState& state, const VertexEdge& pair,
                           double inset = 0, double of_corner = 0);

/// Sets the maps of the pair's points.
void set_maps(const BlockSystem& blocks, const VertexEdge& pair, MovingVertexEdge& motion);

/// Two corners nearer than this times the block size may hand a contact from one's vertex to the other's.
inline constexpr double near_corner = 1e-2;
/// Whether two contacts of the same blocks are where a vertex of one meets a vertex of the other, no further
/// than `near` away, each of them on an edge of the other.
bool exchange_vertices(const BlockSystem& blocks, const BlockState& state, double near, const VertexEdge& old,
                       const VertexEdge& pair);

}  // namespace ddacontact
