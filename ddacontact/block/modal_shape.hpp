/// \file A shape's motions: translation, rotation, and the vibrations about it.
///
/// A node stands at y = c t + R(theta) (X + Phi q), with t = 1 for points, and moves with
///     v = vc t + omega J (y - c t) + R Phi q'.
/// The columns of Phi vibrate by themselves, K Phi = M Phi w^2, are scaled to Phi' M Phi = 1, and carry neither
/// momentum nor angular momentum: sum M Phi = 0, sum X x M Phi = 0 (an Eckart frame). So the matrix of a step is
/// diagonal, diag(m, m, I, 1 + a(w)), whatever the shape.
#pragma once

#include <ddacontact/core/types.hpp>

namespace ddacontact {

struct CorotationalShape;

/// Generalized coordinates or velocities of a block are (centre, angle, deformation): 3 + n_deformations numbers,
/// as many as a block has unknowns.
struct ModalShape {
  explicit ModalShape(const CorotationalShape& shape);

  double mass;              ///< kg per m
  Points nodes;             ///< X, from the centre of mass, 2 x m
  VectorXd translation;     ///< t, m
  VectorXd weights;         ///< of the nodes in the centre of mass, M t / mass, m
  MatrixXd momenta;         ///< M of one axis, m x m
  MatrixXd deformations;    ///< Phi, 2m x k
  VectorXd stiffness;       ///< w^2 of each, 1/s^2, ascending
  MatrixXd momenta_of;      ///< M Phi of both axes, 2m x k
  Points turning;           ///< J X M: its product with velocities is their moment of momentum at rest, 2 x m
  double rest_inertia;      ///< X M X, kg m2 per m
  VectorXd radial;          ///< Phi' M X, k
  Points places;            ///< X of the block's places, 2 x p
  MatrixXd place_deformations;  ///< Phi there, 2p x k

  Index n_deformations() const { return stiffness.size(); }
  Index n_unknowns() const { return 3 + n_deformations(); }

  using Coordinates = Eigen::Ref<const VectorXd>;
  /// X + Phi q, 2 x m.
  Points deformed(const Coordinates& s) const;
  /// I(q) = Z M Z of the deformed shape Z = X + Phi q, and X M Z.
  double inertia(const Coordinates& q) const { return rest_inertia + 2 * radial.dot(q) + q.squaredNorm(); }
  double leverage(const Coordinates& q) const { return rest_inertia + radial.dot(q); }

  /// The coordinates of nodes at y, exact for all that the shape can be. Deformations of the size of round-off are none.
  VectorXd coordinates_of(const PointsRef& y) const;
  /// The velocities (vc, omega, q') of nodes with velocities v in the configuration s.
  VectorXd velocities_of(const Coordinates& s, const PointsRef& v) const;
  /// The velocities of nodes, 2 x m.
  Points node_velocities(const Coordinates& s, const Coordinates& velocities) const;
  /// The displacements of nodes and of places from s to s + change, to the rounding of the change.
  Points node_displacements(const Coordinates& s, const Coordinates& change) const;
};

/// R(angle).
Mat2 turned_by(double angle);

}  // namespace ddacontact
