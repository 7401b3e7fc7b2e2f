/// \file Blocks of a scene file: material, outline, held vertices.
#pragma once

#include <ddacontact/scene/overlap_check.hpp>

#include <array>
#include <string>
#include <vector>

namespace ddacontact::scene_format {

/// Who holds each vertex of each block in each direction.
class Holds {
 public:
  static constexpr int nobody = -1, fixed = -2;

  void add_block(int n_vertices) {
    prescribed_by_.emplace_back(n_vertices, std::array<int, 2>{nobody, nobody});
  }
  int n_vertices(int block) const { return static_cast<int>(prescribed_by_[block].size()); }
  /// `fixed`, the index of a support, or `nobody`. `axis` 0 is x, 1 is y.
  int& by(int block, int vertex, int axis) { return prescribed_by_[block][vertex][axis]; }
  /// Whether every vertex is held in both directions.
  bool holds_all(std::size_t block) const;
  /// Whether some vertex is held in some direction.
  bool holds_any(std::size_t block) const;
  /// Whether the vertex is held in some direction.
  bool holds_vertex(int block, int vertex) const;

 private:
  std::vector<std::vector<std::array<int, 2>>> prescribed_by_;
};

struct BlockTable {
  NameTable names{"block"};
  std::vector<BlockDescription> descriptions;
  std::vector<PositionedOutline> outlines;
  Holds holds;
};

/// `analysis` is that of the scene, resolved.
BlockTable resolve_blocks(const Document& document, const AnalysisOptions& analysis,
                          const NameTable& materials, const NameTable& joints, ProblemList& problems);

/// Complains about indices that are no vertex of a block of `n_vertices` or stand twice; the good ones
/// remain.
std::vector<int> check_vertex_indices(const std::vector<int>& indices, int n_vertices,
                                      const std::string& title, const SourceLocation& location,
                                      ProblemList& problems);

}  // namespace ddacontact::scene_format
