/// \file Triangulations with hanging nodes, for tests.
#pragma once

#include <deal.II/grid/tria.h>

#include <iterator>
#include <random>

namespace support {

/// Refines the cells near one point and coarsens those near another, `n_times`. deal.II coarsens
/// quadrilaterals only.
inline void refine_randomly(dealii::Triangulation<2>& triangulation, int n_times, std::mt19937& random) {
  const auto random_cell_centre = [&] {
    auto cell = triangulation.begin_active();
    std::advance(cell, random() % triangulation.n_active_cells());
    return cell->center();
  };
  for (int k = 0; k < n_times; ++k) {
    const auto fine = random_cell_centre(), coarse = random_cell_centre();
    for (const auto& cell : triangulation.active_cell_iterators()) {
      if (cell->center().distance(fine) < 0.6)
        cell->set_refine_flag();
      else if (cell->center().distance(coarse) < 0.6 && cell->reference_cell().is_hyper_cube())
        cell->set_coarsen_flag();
    }
    triangulation.execute_coarsening_and_refinement();
  }
}

}  // namespace support
