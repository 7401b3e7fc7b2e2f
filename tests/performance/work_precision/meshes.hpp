/// \file The meshes on which problems are solved.
#pragma once

#include <tests/performance/work_precision/problem.hpp>

#include <polyfem/mesh/polygon_mesh.hpp>

namespace work_precision {

/// Cells of a problem's meshes.
enum class Cells { quadrilaterals, hexagons, voronoi, triangles };

/// About as many cells as rows upwards of nearly square ones: all kinds of one level have about the same
/// number of cells, but there are two triangles for each quadrilateral, from which they are cut along the
/// shorter diagonal.
polyfem::PolygonMesh make_mesh(const Problem& problem, Cells cells, int n_rows);

/// The problem's body in this many Voronoi cells.
polyfem::PolygonMesh voronoi_mesh(const Problem& problem, int n_cells);

}  // namespace work_precision
