/// \file How results are told in the scene's own terms.
#pragma once

#include <ddacontact/core/types.hpp>

#include <string>
#include <vector>

namespace ddacontact {

/// What a block's outline is called in the scene. Its vertices are the scene's, 0 .. n_vertices - 1, and
/// nodes between them on the scene's edges, called n_vertices, n_vertices + 1, ... in the scene's direction.
struct OutlineLabels {
  bool turned = false;        ///< the scene gave the vertices clockwise
  int n_vertices = 0;         ///< of the scene
  std::vector<int> vertex;    ///< the scene's number of each vertex of the outline
  std::vector<int> edge;      ///< the scene's edge on which each edge of the outline lies
  std::vector<double> along;  ///< of each vertex of the outline: 0 at the scene's; at a node on an edge what
                              ///< part of the edge lies before it in the scene's direction
};

/// \param[in] outline  at the start, counter-clockwise
/// \param[in] corners  which of its vertices are the scene's, ascending, the first one the scene's first
///                     (the last when `turned`)
OutlineLabels label_outline(const PointsRef& outline, const std::vector<int>& corners, bool turned);
/// All vertices are the scene's.
OutlineLabels label_outline(const PointsRef& outline, bool turned);

/// The program keeps outlines counter-clockwise and coordinates small; results speak of the scene's vertex
/// order and coordinates.
struct Labels {
  Vec2 origin{0, 0};                     ///< what was subtracted from all coordinates
  std::vector<std::string> block_names;  ///< the name, else the index
  std::vector<std::string> block_models;
  std::vector<std::string> block_reasons;   ///< why the block has this model; empty: the scene says so
  std::vector<int> block_materials;         ///< index into material_names
  std::vector<std::string> material_names;  ///< in the order of the scene
  std::vector<OutlineLabels> outlines;      ///< of each block
};

}  // namespace ddacontact
