/// \file What the coordinates of a shape's motions, and their rates, make of its nodes.
#pragma once

#include <ddacontact/block/motion_shape.hpp>

namespace support {

using ddacontact::MotionShape;
using ddacontact::Points;
using ddacontact::VectorXd;

/// X + u, 2 x m.
inline Points deformed(const MotionShape& shape, const VectorXd& s) {
  return shape.nodes + s.tail(2 * shape.n_nodes()).reshaped(2, shape.n_nodes());
}

/// The velocities (vc, omega, u') of nodes with velocities v in the configuration s, and back.
inline VectorXd velocities_of(const MotionShape& shape, const VectorXd& s, const Points& v) {
  const ddacontact::Vec2 of_centre = v * shape.weights;
  const Points Z = deformed(shape, s),
               rates = ddacontact::turned_by(-s[2]) * (v - of_centre * shape.translation.transpose());
  const double angular = shape.turning.cwiseProduct(rates).sum() / shape.weighted.cwiseProduct(Z).sum();
  VectorXd velocities(shape.n_coordinates());
  velocities << of_centre, angular, (rates - angular * ddacontact::left(Z)).reshaped();
  return velocities;
}
inline Points node_velocities(const MotionShape& shape, const VectorXd& s, const VectorXd& velocities) {
  const Points rates = velocities[2] * ddacontact::left(deformed(shape, s)) +
                       velocities.tail(2 * shape.n_nodes()).reshaped(2, shape.n_nodes());
  return ddacontact::turned_by(s[2]) * rates + velocities.head<2>() * shape.translation.transpose();
}

/// The displacements of the nodes from s to s + change, to the rounding of the change.
inline Points node_displacements(const MotionShape& shape, const VectorXd& s, const VectorXd& change) {
  const Points stretch = change.tail(2 * shape.n_nodes()).reshaped(2, shape.n_nodes());
  return ddacontact::turned_by(s[2]) * (ddacontact::turn_less_one(change[2]) * deformed(shape, s) +
                                        ddacontact::turned_by(change[2]) * stretch) +
         change.head<2>() * shape.translation.transpose();
}

}  // namespace support
