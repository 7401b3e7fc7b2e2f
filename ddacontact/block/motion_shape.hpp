/// \file A shape in its own frame: what is rigid in a motion of its nodes, and what deforms it.
///
/// A node stands at y = c t + R(theta) (X + u), with t = 1 for points, and moves with
///     v = vc t + omega J (y - c t) + R u'.
/// c is the centre of mass, and theta such that u carries neither momentum nor angular momentum about the
/// shape at rest: sum M u = 0, sum X x M u = 0 (an Eckart frame). So kinetic energy is m vc^2 / 2 + I omega^2
/// / 2 + u' M u' / 2, with I of the deformed shape, less terms of the order of the strain squared.
#pragma once

#include <ddacontact/block/state.hpp>

#include <Eigen/SparseCore>

namespace ddacontact {

struct CorotationalShape;

/// Coordinates of a block, and its velocities, are (c, theta, u) of its nodes: 3 + 2 m numbers.
struct MotionShape {
  explicit MotionShape(const CorotationalShape& shape);

  double mass;           ///< kg per m
  double rest_inertia;   ///< X M X, kg m2 per m
  Points nodes;          ///< X, from the centre of mass, 2 x m
  VectorXd translation;  ///< t, m
  VectorXd weights;      ///< of the nodes in the centre of mass, M t / mass, m
  Points weighted;       ///< X M, 2 x m
  Points turning;        ///< J X M: its product with velocities is their moment of momentum at rest, 2 x m
  Eigen::SparseMatrix<double> stiffness;  ///< K of all cells, 2m x 2m; empty: that of the only one

  Index n_nodes() const { return nodes.cols(); }
  Index n_coordinates() const { return BlockState::n_rigid + nodes.size(); }

  /// The coordinates of nodes at y, with the angle in (-pi, pi]. Deformations of the size of round-off are
  /// none.
  VectorXd coordinates_of(const PointsRef& y) const;
};

/// a, and a turned to the left: of a unit vector the rotation that leads the first axis to it.
inline Mat2 turned_to(const Vec2& a) {
  return Mat2{{a.x(), -a.y()}, {a.y(), a.x()}};
}
/// R(angle).
Mat2 turned_by(double angle);
/// R(angle) - 1 without cancellation.
Mat2 turn_less_one(double angle);

/// A quarter turn to the left of every vector.
template <class Vectors>
Vectors left(const Vectors& of) {
  Vectors turned(2, of.cols());
  turned.row(0) = -of.row(1);
  turned.row(1) = of.row(0);
  return turned;
}

}  // namespace ddacontact
