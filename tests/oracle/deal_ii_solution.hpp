/// \file A plane strain problem assembled and solved by deal.II.
#pragma once

#include <polyfem/dealii/triangulation_mesh.hpp>
#include <tests/oracle/plane_strain.hpp>

namespace oracle {

/// Displacements d = (u1 v1 u2 v2 ...) at the vertices of the triangulation's mesh (without hanging nodes):
/// bilinear quadrilaterals with 8 x 8 Gauss points or linear triangles with an exact rule, and UMFPACK.
polyfem::VectorXd deal_ii_solution(const dealii::Triangulation<2, 2>& triangulation,
                                   const polyfem::TriangulationMesh& mesh, const PlaneStrain& problem);

}  // namespace oracle
