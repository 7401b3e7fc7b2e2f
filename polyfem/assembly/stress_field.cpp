#include <polyfem/assembly/stress_field.hpp>

#include <polyfem/core/error.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/element/stress_recovery.hpp>
#include <polyfem/mesh/vertex_averages.hpp>

namespace polyfem {

StressField stress_field(const PolygonMesh& mesh, const Eigen::Ref<const VectorXd>& u,
                         const TabulateCell& tabulate_cell, const CellElasticity& elasticity) {
  require_numbering(mesh);
  if (u.size() != 2 * mesh.vertices.cols())
    throw Error("a stress field needs two displacements a vertex, " +
                std::to_string(2 * mesh.vertices.cols()) + ", not " + std::to_string(u.size()));
  const Eigen::Map<const Points> displacements(u.data(), 2, mesh.vertices.cols());
  StressField field;
  field.of_cells.resize(3, mesh.n_cells());
  MatrixXd at_corners(3, static_cast<Index>(mesh.indices.size())), of_cell;
  TabulatedElement element;
  Tensors strain;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const Points polygon = mesh.outline(c);
    try {
      tabulate_cell(c, polygon, element);
    } catch (const Error& error) {
      throw Error("cell " + std::to_string(c) + ": " + error.what());
    }
    const std::span<const int> corners = mesh.cell(c);
    const Points d = displacements(Eigen::all, std::vector<int>(corners.begin(), corners.end()));
    strains(element, d.reshaped(), strain);
    const Tensors stress = elasticity(c) * strain;
    field.of_cells.col(c) = stress * element.rule.weights / element.area;
    extrapolate_to_vertices(polygon, element, stress, of_cell);
    at_corners.middleCols(mesh.offsets[c], polygon.cols()) = of_cell;
  }
  field.at_vertices = vertex_averages(mesh, at_corners);
  return field;
}

}  // namespace polyfem
