#include <polyfem/assembly/stress_field.hpp>

#include <polyfem/assembly/field_values.hpp>
#include <polyfem/core/error.hpp>
#include <polyfem/element/b_bar.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/element/stress_recovery.hpp>
#include <polyfem/mesh/vertex_averages.hpp>

namespace polyfem {
namespace {

/// Gathers the tensors of one cell after another.
class Gathering {
 public:
  explicit Gathering(const PolygonMesh& mesh)
      : mesh_(mesh), of_cells_(3, mesh.n_cells()), at_corners_(3, static_cast<Index>(mesh.indices.size())) {}

  void add(int cell, const PointsRef& polygon, const TabulatedElement& element, const Tensors& tensors) {
    of_cells_.col(cell) = tensors * element.rule.weights / element.area;
    extrapolate_to_vertices(polygon, element, tensors, of_cell_);
    at_corners_.middleCols(mesh_.offsets[static_cast<std::size_t>(cell)], polygon.cols()) = of_cell_;
    at_points_.insert(at_points_.end(), tensors.data(), tensors.data() + tensors.size());
  }
  TensorField take() const {
    return {of_cells_, vertex_averages(mesh_, at_corners_),
            Eigen::Map<const Tensors>(at_points_.data(), 3, std::ssize(at_points_) / 3)};
  }

 private:
  const PolygonMesh& mesh_;
  Tensors of_cells_;
  MatrixXd at_corners_, of_cell_;
  std::vector<double> at_points_;
};

/// Replaces the change of area at each point by its mean.
void average_dilatation(const TabulatedElement& element, Tensors& strain) {
  const Eigen::RowVectorXd dilatation = strain.row(0) + strain.row(1);
  const double mean = dilatation.dot(element.rule.weights) / element.area;
  strain.topRows<2>().rowwise() += ((mean - dilatation.array()) / 2).matrix();
}

}  // namespace

StressField stress_field(const PolygonMesh& mesh, const Eigen::Ref<const VectorXd>& u,
                         const TabulateCell& tabulate_cell, const CellElasticity& elasticity,
                         Dilatation dilatation) {
  require_numbering(mesh);
  if (u.size() != 2 * mesh.vertices.cols())
    throw Error("a stress field needs two displacements a vertex, " +
                std::to_string(2 * mesh.vertices.cols()) + ", not " + std::to_string(u.size()));
  Gathering stresses(mesh), all_strains(mesh);
  std::vector<double> points;
  StressField field;
  field.first_point = {0};
  TabulatedElement element;
  Tensors strain, stress;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const Points polygon = mesh.outline(c);
    try {
      tabulate_cell(c, polygon, element);
    } catch (const Error& error) {
      throw Error("cell " + std::to_string(c) + ": " + error.what());
    }
    const VectorXd d = cell_values(mesh, c, u);
    strains(element, d, strain);
    if (dilatation == Dilatation::mean) {
      b_bar_stresses(element, elasticity(c), d, stress);
      average_dilatation(element, strain);
    } else {
      stress = elasticity(c) * strain;
    }
    stresses.add(c, polygon, element, stress);
    all_strains.add(c, polygon, element, strain);
    points.insert(points.end(), element.rule.points.data(),
                  element.rule.points.data() + element.rule.points.size());
    field.first_point.push_back(std::ssize(points) / 2);
  }
  field.stress = stresses.take();
  field.strain = all_strains.take();
  field.points = Eigen::Map<const Points>(points.data(), 2, std::ssize(points) / 2);
  return field;
}

}  // namespace polyfem
