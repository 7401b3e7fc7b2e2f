/// \file Runs a scene and takes its invariants.
#pragma once

#include "scene_list.hpp"
#include "table.hpp"

namespace regression {

/// Runs the scene to its end and states each of its numbers as a row that expects just it, or as a bound with
/// what was `seen`.
struct Measured {
  Row row;
  double seen = 0;
};

/// Tolerances are the class' share of a scale of the scene: of forces the weight of the free blocks or the
/// largest load (without either the largest force seen), of displacements the size of the smallest free block
/// (without any contact the largest displacement seen), of energies the largest one seen. Throws Error when
/// the scene cannot be read or the run stops.
std::vector<Measured> measure(const ListedScene& scene);

}  // namespace regression
