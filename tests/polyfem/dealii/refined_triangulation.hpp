/// \file Triangulations with hanging nodes, for tests.
#pragma once

#include <deal.II/grid/tria.h>

#include <random>

namespace support {

/// Refines a random third of the cells and coarsens as many, `n_times`.
inline void refine_randomly(dealii::Triangulation<2>& triangulation, int n_times, std::mt19937& random) {
  for (int k = 0; k < n_times; ++k) {
    for (const auto& cell : triangulation.active_cell_iterators()) {
      if (const auto lot = random() % 3; lot == 0)
        cell->set_refine_flag();
      else if (lot == 1)
        cell->set_coarsen_flag();
    }
    triangulation.execute_coarsening_and_refinement();
  }
}

}  // namespace support
