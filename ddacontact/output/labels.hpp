/// \file How results are told in the scene's own terms.
#pragma once

#include <ddacontact/core/types.hpp>

#include <memory>
#include <string>
#include <vector>

namespace ddacontact {

/// What a block's outline is called in the scene. Its vertices are the scene's, 0 .. n_vertices - 1, and
/// nodes between them on the scene's edges, called n_vertices, n_vertices + 1, ... in the scene's direction.
struct OutlineLabels {
  bool turned = false;      ///< the scene gave the vertices clockwise
  int n_vertices = 0;       ///< of the scene
  std::vector<int> vertex;  ///< the scene's number of each vertex of the outline
  std::vector<int> edge;    ///< the scene's edge on which each edge of the outline lies

  /// The vertices of the outline by their numbers in the scene.
  std::vector<int> in_scene_order() const;
};

/// \param[in] n_outline  vertices of the outline, counter-clockwise
/// \param[in] corners    which of them are the scene's, ascending, the first one the scene's first (the last
///                       when `turned`)
OutlineLabels label_outline(int n_outline, const std::vector<int>& corners, bool turned);
/// All vertices are the scene's.
OutlineLabels label_outline(int n_vertices, bool turned);

/// The program keeps outlines counter-clockwise and coordinates small; results speak of the scene's vertex
/// order and coordinates.
struct Labels {
  Vec2 origin{0, 0};                     ///< what was subtracted from all coordinates
  std::vector<std::string> block_names;  ///< the name, else the index
  std::vector<std::string> block_models;
  std::vector<std::string> block_reasons;   ///< why the block has this model; empty: the scene says so
  std::vector<int> block_materials;         ///< index into material_names
  std::vector<std::string> material_names;  ///< in the order of the scene
  std::vector<std::string> joint_names;     ///< the name, else the index
  std::vector<std::shared_ptr<const OutlineLabels>> outlines;  ///< of each block; many share theirs
  bool has_bolts = false;                                      ///< some stage has
  std::vector<int> supported_blocks;                           ///< that a [[support]] names, ascending
};

}  // namespace ddacontact
