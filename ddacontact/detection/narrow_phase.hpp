/// \file Where two polygons touch or may touch within a step: vertices against edges.
#pragma once

#include <ddacontact/core/tolerances.hpp>
#include <ddacontact/core/types.hpp>
#include <ddacontact/detection/outline_table.hpp>

#include <array>
#include <compare>
#include <span>
#include <vector>

namespace ddacontact {

/// A vertex of one block and the edge of another that it may meet. Edge k runs from vertex k to vertex k + 1.
struct VertexEdge {
  int vertex_block = 0, vertex = 0, edge_block = 0, edge = 0;
  bool corner = false;  ///< a rounded vertex against the corner where the edge starts
  auto operator<=>(const VertexEdge&) const = default;
  std::array<int, 2> blocks() const { return {vertex_block, edge_block}; }
};

/// One of the two polygons of a pair, at the start of a step and where a predicted motion takes it.
struct Outline {
  int block;
  PointsRef vertices;  ///< simple, counter-clockwise
  PointsRef moved;     ///< the same vertices at the end of the predicted motion
  OutlineSides sides{{}, {Vec2::Zero(), Vec2::Zero()}, false};  ///< the box from the origin of the vertices

  /// At rest.
  Outline(int number, const PointsRef& at) : block(number), vertices(at), moved(at) {}
  Outline(int number, const PointsRef& start, const PointsRef& end)
      : block(number), vertices(start), moved(end) {}
};

/// By what the contacts of two polygons are chosen: lengths, m, and an angle.
struct PairLimits {
  double search_margin;  ///< pairs of features further apart than this cannot meet within the step
  double max_depth;      ///< a vertex deeper inside than this did not come through this edge
  double coincidence;    ///< two vertices no further apart along the edge than this coincide
  double lip;  ///< a vertex passes an edge's line when it is further behind it than this; infinity: none
               ///< is passed, and of lines that a corner may meet it takes that with the largest gap
  double largest_turn = 0.5;  ///< sine of the angle by which their sides may turn within the step

  /// A line is behind a vertex inside the other polygon when the vertex is deeper than this.
  double depth_inside() const { return lip < max_depth ? lip : coincidence; }

  /// The forces of a step press contacts in by about this: smaller differences of gaps do not tell anything.
  double pressed_in() const { return 1e-2 * coincidence; }
};

/// A contact of the step before.
struct EarlierContact {
  VertexEdge pair;
  double gap_offset = 0;  ///< <= 0: the gap from which the contact's own gap counts, m
  bool closed = true;
};

/// A part of an edge of one of the two polygons on which a third one lies: nothing enters there, and a corner
/// at its end is that of both together.
struct CoveredPart {
  int block, edge;
  double from, to;     ///< m from the start of the edge
  Vec2 before, after;  ///< the sides of the third one that go on from there, away from either end
};

/// A contact whose corner may meet another edge's line as well.
struct Choice {
  VertexEdge chosen;
  bool open;  ///< the predicted motion does not tell which
  bool kept;  ///< it was closed before
};

/// The contacts of one or several pairs, and where they were preferred to others.
struct FoundContacts {
  std::vector<VertexEdge> contacts;
  std::vector<Choice> choices;
};

/// Appends the contacts of a pair: the vertices of `a` on edges of `b`, then those of `b`.
///
/// A vertex may enter through an edge on whose outer side its whole corner lies; a reflex one through none.
/// Of edges that are collinear with their neighbours it meets the one it is over. A convex polygon is entered
/// when the last of its edges' lines is passed, and that line is the contact: see `later`. So it is with
/// edges of any polygon between which the outline turns left; edges with a reflex corner between them, as the
/// two of a notch, are met each. A line passed before the step begins is no contact, unless all are: a vertex
/// inside came in through the nearest edge, or one that was closed before, and of edges that it is behind
/// meets besides only the other one of a notch.
///
/// Two touching edges come out as the two ends of their overlap; where vertex meets vertex the lines of both
/// corners are compared, and the one passed last stays. Where that leaves a tie, an earlier contact wins, so
/// that a resting contact keeps its lock point; an open one too, so that faces that only lie at each other do
/// not change contacts by their last digits. `choices`: the lines that a contact was preferred to, none of
/// them passed at the start. Where one is open the step's forces have to tell.
///
/// \param[in] a, b     with their sides
/// \param[in] covered  lines that are no entrance where there is another, and none for a corner with both
///   sides covered
void find_contacts(const Outline& a, const Outline& b, const PairLimits& limits,
                   std::span<const EarlierContact> earlier, std::span<const CoveredPart> covered,
                   FoundContacts& found);

}  // namespace ddacontact
