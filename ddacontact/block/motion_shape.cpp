#include <ddacontact/block/motion_shape.hpp>

#include <ddacontact/block/corotational_shape.hpp>
#include <ddacontact/core/tolerances.hpp>

#include <cmath>
#include <vector>

namespace ddacontact {

Eigen::SparseMatrix<double> sum_of_cells(const CorotationalShape& shape, int per_node,
                                         const std::function<const MatrixXd&(const ShapeCell&)>& of_cell) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const ShapeCell& cell : shape.cells) {
    const MatrixXd& A = of_cell(cell);
    const auto row = [&](Index k) { return per_node * cell.nodes[k / per_node] + k % per_node; };
    for (Index k = 0; k < A.rows(); ++k)
      for (Index l = 0; l < A.cols(); ++l) entries.emplace_back(row(k), row(l), A(k, l));
  }
  Eigen::SparseMatrix<double> sum(per_node * shape.nodes.cols(), per_node * shape.nodes.cols());
  sum.setFromTriplets(entries.begin(), entries.end());
  return sum;
}

Mat2 turned_by(double angle) {
  return turned_to({std::cos(angle), std::sin(angle)});
}

Mat2 turn_less_one(double angle) {
  const double half = std::sin(angle / 2);
  return turned_to({-2 * half * half, std::sin(angle)});
}

MotionShape::MotionShape(const CorotationalShape& shape)
    : mass(shape.mass_total),
      translation(shape.translation),
      weights(shape.mass_of_translation / shape.mass_total) {
  const Vec2 centre = shape.nodes * weights;
  nodes = shape.nodes - centre * translation.transpose();
  weighted = shape.is_one_cell() ? Points(nodes * shape.cells[0].mass) : Points(nodes * shape.mass);
  turning = left(weighted);
  rest_inertia = weighted.cwiseProduct(nodes).sum();
  if (!shape.is_one_cell())
    stiffness = sum_of_cells(
        shape, 2, [](const ShapeCell& cell) -> const MatrixXd& { return cell.elastic.stiffness(); });
}

VectorXd MotionShape::coordinates_of(const PointsRef& y) const {
  const Vec2 centre = y * weights;
  const Points arms = y - centre * translation.transpose();
  const double angle = std::atan2(turning.cwiseProduct(arms).sum(), weighted.cwiseProduct(arms).sum());
  Points u = turned_by(-angle) * arms - nodes;
  if (u.cwiseAbs().maxCoeff() <= 2 * few_ulps * nodes.cwiseAbs().maxCoeff()) u.setZero();
  VectorXd s(n_coordinates());
  s << centre, angle, u.reshaped();
  return s;
}

}  // namespace ddacontact
