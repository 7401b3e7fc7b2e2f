/// \file How results are told in the scene's own terms.
#pragma once

#include <ddacontact/core/types.hpp>

#include <string>
#include <vector>

namespace ddacontact {

/// The program keeps outlines counter-clockwise and coordinates small; results speak of the scene's vertex
/// order and coordinates.
struct Labels {
  Vec2 origin{0, 0};                     ///< what was subtracted from all coordinates
  std::vector<std::string> block_names;  ///< the name, else the index
  std::vector<std::string> block_models;
  std::vector<int> block_materials;         ///< index into material_names
  std::vector<std::string> material_names;  ///< in the order of the scene
  std::vector<bool> turned;  ///< the scene gave this block's vertices clockwise

  /// The scene's index of a block's vertex or edge, given ours; the map is its own inverse.
  int scene_vertex(int block, int vertex, int n_vertices) const {
    return turned[block] ? n_vertices - 1 - vertex : vertex;
  }
  int scene_edge(int block, int edge, int n_vertices) const {
    return turned[block] ? (2 * n_vertices - 2 - edge) % n_vertices : edge;
  }
};

}  // namespace ddacontact
