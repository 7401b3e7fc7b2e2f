/// \file Blocks made simpler: without straight vertices and short edges, and concave ones as several convex
/// ones.
#pragma once

#include <ddacontact/scene/scene.hpp>

namespace ddacontact {

/// What to do, in this order.
struct CutOptions {
  double shortest_edge = 0;    ///< edges shorter than this times the size of their block become a vertex
  bool drop_straight = false;  ///< vertices that turn by at most 1e-9 (a sine) go
  bool convex = false;         ///< what is concave is split; straight vertices of what comes of it go too
};

/// What was done.
struct CutCounts {
  int short_edges = 0, straight_vertices = 0;
  int split = 0;        ///< blocks that became several
  int lost_holds = 0;   ///< vertices in a list `fixed` that are in no block any more
  int mixed_edges = 0;  ///< edges that lie on several, of different joints, or in part on none
};

/// The scene with its blocks cut, without supports, loads and monitors, which count vertices and edges as
/// they were. The parts of a block called NAME are NAME.1, NAME.2, ...; they have its material, model, mesh
/// and stress, move with it at the start, are held where it was, and go with it in a stage that takes it out.
/// An edge follows the joint of the edge that it lies on, of several the one of the greatest length; a cut
/// that of the materials.
/// Throws Error when such a name is taken.
Scene cut_blocks(const Scene& scene, const CutOptions& options, CutCounts& counts);

}  // namespace ddacontact
