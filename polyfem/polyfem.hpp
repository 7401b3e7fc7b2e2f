/// \file Everything that codes built on polyfem use, in one header: finite elements on polygons.
///
/// Which basis, rule and correction: those of `tabulate(cell, element)` and `tabulate_quadratic(cell,
/// element)`, which are the default (`element/default_element.hpp`); `tabulate_to_tolerance` where an error
/// bound is wanted. Files that build slowly include the single headers instead: meshes (`mesh/voronoi.hpp`),
/// elements (`element/matrices.hpp`), problems (`assembly/field_problem.hpp`).
#pragma once

// Shape functions and their integrals.
#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/quadratic_shapes.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/core/error.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/validity.hpp>
#include <polyfem/quadrature/graded_rule.hpp>
#include <polyfem/quadrature/triangle_rule.hpp>

// Matrices, loads, errors and stresses of cells.
#include <polyfem/element/b_bar.hpp>
#include <polyfem/element/default_element.hpp>
#include <polyfem/element/definiteness.hpp>
#include <polyfem/element/diffusion.hpp>
#include <polyfem/element/element_report.hpp>
#include <polyfem/element/error_norms.hpp>
#include <polyfem/element/finite_strain.hpp>
#include <polyfem/element/loads.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/element/mean_dilatation.hpp>
#include <polyfem/element/quadratic_element.hpp>
#include <polyfem/element/small_strain.hpp>
#include <polyfem/element/stress_recovery.hpp>
#include <polyfem/element/tolerance.hpp>
#include <polyfem/element/virtual_element.hpp>

// Materials.
#include <polyfem/material/isotropic_damage.hpp>
#include <polyfem/material/j2_plasticity.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/material/neo_hooke.hpp>

// Meshes and their files.
#include <polyfem/io/gmsh_reader.hpp>
#include <polyfem/io/mesh_file.hpp>
#include <polyfem/io/off_file.hpp>
#include <polyfem/io/pvd_file.hpp>
#include <polyfem/io/vtu_mesh.hpp>
#include <polyfem/io/vtu_reader.hpp>
#include <polyfem/mesh/cell_division.hpp>
#include <polyfem/mesh/cut_cells.hpp>
#include <polyfem/mesh/cut_grid.hpp>
#include <polyfem/mesh/edge_midpoints.hpp>
#include <polyfem/mesh/generators.hpp>
#include <polyfem/mesh/mesh_boundary.hpp>
#include <polyfem/mesh/mesh_defects.hpp>
#include <polyfem/mesh/named_mesh.hpp>
#include <polyfem/mesh/periodic_vertices.hpp>
#include <polyfem/mesh/point_locator.hpp>
#include <polyfem/mesh/vertex_averages.hpp>
#include <polyfem/mesh/vertex_moves.hpp>
#include <polyfem/mesh/voronoi.hpp>

// Fields on meshes.
#include <polyfem/assembly/blas.hpp>
#include <polyfem/assembly/field_problem.hpp>
#include <polyfem/assembly/field_values.hpp>
#include <polyfem/assembly/history.hpp>
#include <polyfem/assembly/newmark_scheme.hpp>
#include <polyfem/assembly/nonlinear_problem.hpp>
#include <polyfem/assembly/stress_field.hpp>
#include <polyfem/assembly/theta_scheme.hpp>
