/// \file Parts of a mesh that nothing keeps from moving.
#pragma once

#include <polyfem/assembly/tied_unknowns.hpp>
#include <polyfem/mesh/polygon_mesh.hpp>

#include <optional>

namespace polyfem {

/// A motion without stiffness of cells that are connected.
struct FreeMotion {
  int vertex = 0;        ///< one of the part's
  int n_vertices = 0;    ///< of the part
  VectorXd translation;  ///< of its middle, one entry a component
  double rotation = 0;   ///< what turning moves the part's farthest vertex by
};

/// A constant, or with two components also a rotation, of a part of the mesh that leaves prescribed degrees
/// of freedom where they are, keeps ties and costs no energy to round-off; nothing when there is none. Parts
/// that are tied to each other count as one. `lower` may have prescribed rows and columns taken out.
std::optional<FreeMotion> find_free_motion(const PolygonMesh& mesh, int n_components,
                                           const SparseMatrix& lower, const PrescribedDofs& prescribed,
                                           const TiedUnknowns& tied);

}  // namespace polyfem
