/// \file Which vertices and edges of a scene's blocks are held, and how they move.
#pragma once

#include <ddacontact/core/time_function.hpp>
#include <ddacontact/scene/placed_block.hpp>

#include <array>
#include <optional>
#include <vector>

namespace ddacontact {

/// Where each vertex of a block is held, by axis; no entry: free.
using VertexHolds = std::vector<std::array<std::optional<TimeFunction>, 2>>;

/// How a block is held: its vertices, and the edges (by their first vertex) both ends of which are held at
/// once, by one support or by the block itself. What two supports hold are points: the edge between them is
/// free.
struct Holds {
  VertexHolds vertices, edges;

  explicit Holds(Index n) : vertices(n), edges(n) {}

  void hold(const std::vector<int>& prescribed, int axis, const TimeFunction& motion) {
    std::vector<bool> is_prescribed(vertices.size());
    for (int v : prescribed) is_prescribed[v] = true;
    for (std::size_t v = 0; v < is_prescribed.size(); ++v) {
      if (!is_prescribed[v]) continue;
      vertices[v][axis] = motion;
      if (is_prescribed[(v + 1) % is_prescribed.size()]) edges[v][axis] = motion;
    }
  }
};

/// Of all blocks, by their supports and as `fixed` says; vertices are counted counter-clockwise.
std::vector<Holds> collect_holds(const Scene& scene, const std::vector<PlacedBlock>& placed);
/// Throws where an affine field, which three vertices tell, cannot follow what is asked of a fourth.
void check_followed(const VertexHolds& holds, const PointsRef& outline, const std::array<int, 3>& control,
                    int axis, const Scene& scene, int block);

}  // namespace ddacontact
