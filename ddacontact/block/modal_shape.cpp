#include <ddacontact/block/modal_shape.hpp>

#include <ddacontact/block/corotational_shape.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ddacontact {

namespace {

/// A quarter turn to the left of every vector.
Points left(const Points& of) {
  Points turned(2, of.cols());
  turned.row(0) = -of.row(1);
  turned.row(1) = of.row(0);
  return turned;
}

/// M of both axes times displacements, one a column.
MatrixXd times_mass(const MatrixXd& momenta, const MatrixXd& displacements) {
  MatrixXd result(displacements.rows(), displacements.cols());
  for (Index k = 0; k < displacements.cols(); ++k)
    result.col(k) = (displacements.col(k).reshaped(2, momenta.rows()) * momenta).reshaped();
  return result;
}

MatrixXd mass_of(const CorotationalShape& shape) {
  return shape.is_one_cell() ? shape.cells[0].mass : MatrixXd(shape.mass);
}

/// K of all nodes at rest times displacements, one a column.
MatrixXd times_stiffness(const CorotationalShape& shape, const MatrixXd& displacements) {
  if (shape.is_one_cell()) return shape.cells[0].elastic.stiffness() * displacements;
  MatrixXd result = MatrixXd::Zero(displacements.rows(), displacements.cols());
  for (const ShapeCell& cell : shape.cells) {
    std::vector<Index> rows;
    for (int node : cell.nodes) rows.insert(rows.end(), {2 * node, 2 * node + 1});
    result(rows, Eigen::all) += cell.elastic.stiffness() * displacements(rows, Eigen::all);
  }
  return result;
}

}  // namespace

Mat2 turned_by(double angle) { return Eigen::Rotation2Dd(angle).toRotationMatrix(); }

ModalShape::ModalShape(const CorotationalShape& shape)
    : mass(shape.mass_total),
      translation(shape.translation),
      weights(shape.mass_of_translation / shape.mass_total),
      momenta(mass_of(shape)) {
  const Vec2 centre = shape.nodes * weights;
  nodes = shape.nodes - centre * translation.transpose();

  // Displacements that the unknowns can make, orthonormal in M: the rigid ones first, then the others.
  const Index m = nodes.cols(), n = shape.n_unknowns();
  const MatrixXd possible = shape.has_basis() ? MatrixXd(shape.basis) : MatrixXd::Identity(2 * m, 2 * m);
  const Eigen::LLT<MatrixXd> factor(possible.transpose() * times_mass(momenta, possible));
  MatrixXd rigid(2 * m, 3);
  rigid.col(0) = (Vec2::UnitX() * translation.transpose()).reshaped();
  rigid.col(1) = (Vec2::UnitY() * translation.transpose()).reshaped();
  rigid.col(2) = left(nodes).reshaped();
  const MatrixXd rigid_by_unknowns = factor.matrixL().solve(possible.transpose() * times_mass(momenta, rigid));
  const Eigen::HouseholderQR<MatrixXd> split(rigid_by_unknowns);
  const MatrixXd others = split.householderQ() * MatrixXd::Identity(n, n).rightCols(n - 3),
                 basis = possible * factor.matrixU().solve(others);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> vibrations(basis.transpose() * times_stiffness(shape, basis));
  deformations = basis * vibrations.eigenvectors();
  stiffness = vibrations.eigenvalues().cwiseMax(0);
  momenta_of = times_mass(momenta, deformations);
  turning = left(nodes * momenta);
  rest_inertia = (nodes * momenta).cwiseProduct(nodes).sum();
  radial = momenta_of.transpose() * nodes.reshaped();

  if (shape.places.size() == 0) {
    places = nodes;
    place_deformations = deformations;
    return;
  }
  places = nodes * shape.places.transpose();
  place_deformations.resize(2 * shape.places.rows(), n_deformations());
  for (Index k = 0; k < n_deformations(); ++k)
    place_deformations.col(k) = (deformations.col(k).reshaped(2, m) * shape.places.transpose()).reshaped();
}

Points ModalShape::deformed(const Coordinates& s) const {
  return nodes + (deformations * s.tail(n_deformations())).reshaped(2, nodes.cols());
}

VectorXd ModalShape::coordinates_of(const PointsRef& y) const {
  const Vec2 centre = y * weights;
  const Points arms = y - centre * translation.transpose();
  const double sine = turning.cwiseProduct(arms).sum(),
               cosine = (nodes * momenta).cwiseProduct(arms).sum(),
               angle = std::atan2(sine, cosine);
  Points u = turned_by(-angle) * arms - nodes;
  constexpr double round_off = 16 * std::numeric_limits<double>::epsilon();
  if (u.cwiseAbs().maxCoeff() <= round_off * nodes.cwiseAbs().maxCoeff()) u.setZero();
  VectorXd s(n_unknowns());
  s << centre, angle, momenta_of.transpose() * u.reshaped();
  return s;
}

VectorXd ModalShape::velocities_of(const Coordinates& s, const PointsRef& v) const {
  const Vec2 of_centre = v * weights;
  const Points Z = deformed(s), rates = turned_by(-s[2]) * (v - of_centre * translation.transpose());
  const double angular = turning.cwiseProduct(rates).sum() / leverage(s.tail(n_deformations()));
  VectorXd velocities(n_unknowns());
  velocities << of_centre, angular, momenta_of.transpose() * (rates - angular * left(Z)).reshaped();
  return velocities;
}

Points ModalShape::node_velocities(const Coordinates& s, const Coordinates& velocities) const {
  const Points rates = velocities[2] * left(deformed(s)) +
                       (deformations * velocities.tail(n_deformations())).reshaped(2, nodes.cols());
  return turned_by(s[2]) * rates + velocities.head<2>() * translation.transpose();
}

Points ModalShape::node_displacements(const Coordinates& s, const Coordinates& change) const {
  const double half = std::sin(change[2] / 2);
  Mat2 turn;  // R(change) - 1 without cancellation
  turn << -2 * half * half, -std::sin(change[2]), std::sin(change[2]), -2 * half * half;
  const Points stretch = (deformations * change.tail(n_deformations())).reshaped(2, nodes.cols());
  return turned_by(s[2]) * (turn * deformed(s) + turned_by(change[2]) * stretch) +
         change.head<2>() * translation.transpose();
}

}  // namespace ddacontact
