/// \file How much memory a run of a scene takes, told before anything of it is built.
#pragma once

#include <ddacontact/scene/scene.hpp>

#include <string>

namespace ddacontact {

/// Bytes, by what takes them.
struct MemoryEstimate {
  double scene = 0;        ///< as it is read and kept
  double blocks = 0;       ///< shapes, states, forces
  double contacts = 0;     ///< about three for two vertices
  double matrix = 0;       ///< of a step, with the index arrays of its assembly, or of what replaces it
  double factor = 0;       ///< c n log2 n entries of n rows, and what making it takes; 0: see `has_factor`
  bool has_factor = true;  ///< whether a factor is counted: see needs_factor
  double n_rows = 0;       ///< unknowns that are not held

  double total() const { return scene + blocks + contacts + matrix + factor; }
};

/// Whether steps are so long that a factor of their equations will be made, or may be: where waves cross no
/// block in a step (`carries_waves`) blocks of few unknowns are solved without. Slender blocks may become
/// meshes by the choice of models.
bool needs_factor(const Scene& scene);

/// Bytes as "3.4 GB".
std::string bytes_text(double bytes);

/// Bytes for so many quadrilaterals of the simplest model, without a factor, and for the pairs of them whose
/// boxes overlap: the least that a scene takes.
double least_memory(double n_blocks, double n_box_pairs);

/// From the numbers of vertices and of cells alone: blocks of the model "auto" count as undivided, contacts
/// as in a dense packing.
MemoryEstimate estimate_memory(const Scene& scene);

/// What part of the blocks, or of their cells, takes `bytes`; 0 where the program itself does.
double part_that_fits(const MemoryEstimate& estimate, double bytes);

}  // namespace ddacontact
