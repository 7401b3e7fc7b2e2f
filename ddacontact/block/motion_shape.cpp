#include <ddacontact/block/motion_shape.hpp>

#include <ddacontact/block/corotational_shape.hpp>
#include <ddacontact/core/tolerances.hpp>

#include <cmath>
#include <vector>

namespace ddacontact {

namespace {

Eigen::SparseMatrix<double> stiffness_of(const CorotationalShape& shape) {
  const Index n = 2 * shape.nodes.cols();
  std::vector<Eigen::Triplet<double>> entries;
  for (const ShapeCell& cell : shape.cells)
    for (std::size_t a = 0; a < cell.nodes.size(); ++a)
      for (std::size_t b = 0; b < cell.nodes.size(); ++b)
        for (int i = 0; i < 2; ++i)
          for (int j = 0; j < 2; ++j)
            entries.emplace_back(
                2 * cell.nodes[a] + i, 2 * cell.nodes[b] + j,
                cell.elastic.stiffness()(2 * static_cast<Index>(a) + i, 2 * static_cast<Index>(b) + j));
  Eigen::SparseMatrix<double> K(n, n);
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}

}  // namespace

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
  if (!shape.is_one_cell()) stiffness = stiffness_of(shape);
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
