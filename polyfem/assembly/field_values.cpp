#include <polyfem/assembly/field_values.hpp>

#include <polyfem/basis/quadratic_shapes.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/core/error.hpp>

namespace polyfem {

VectorXd cell_values(const PolygonMesh& mesh, int cell, const Eigen::Ref<const VectorXd>& u) {
  const Index n_vertices = mesh.vertices.cols();
  if (u.size() == 0 || u.size() % n_vertices != 0)
    throw Error("a field has as many values at each of the " + std::to_string(n_vertices) +
                " vertices of its mesh: " + std::to_string(u.size()) + " values are of another one");
  if (cell < 0 || cell >= mesh.n_cells())
    throw Error("there is no cell " + std::to_string(cell) + ": cells are numbered 0 to " +
                std::to_string(mesh.n_cells() - 1));
  const Index n_components = u.size() / n_vertices;
  const std::span<const int> vertices = mesh.cell(cell);
  VectorXd values(n_components * std::ssize(vertices));
  for (Index k = 0; k < std::ssize(vertices); ++k)
    values.segment(n_components * k, n_components) =
        u.segment(n_components * vertices[static_cast<std::size_t>(k)], n_components);
  return values;
}

FieldAtPoint field_at(const PolygonMesh& mesh, const Eigen::Ref<const VectorXd>& u, const Located& there,
                      CellOrder order) {
  const VectorXd d = cell_values(mesh, there.cell, u);
  const Points cell = mesh.outline(there.cell);
  ShapeTable shape;
  if (order == CellOrder::quadratic)
    evaluate_quadratic(cell, suitable_basis(quadratic_corners(cell)), there.point, shape);
  else
    suitable_basis(cell).evaluate(cell, there.point, shape);
  const auto of_vertices = d.reshaped(d.size() / cell.cols(), cell.cols());
  FieldAtPoint field{of_vertices * shape.values.transpose(), MatrixXd(of_vertices.rows(), 2)};
  field.gradient << of_vertices * shape.dx.transpose(), of_vertices * shape.dy.transpose();
  return field;
}

}  // namespace polyfem
