/// \file Moments of the stress in a block that follow from the forces on it, whatever carries it inside.
#pragma once

#include <ddacontact/core/types.hpp>
#include <polyfem/quadrature/polygon_rule.hpp>

#include <span>

namespace ddacontact {

/// A force per metre of thickness and the point that it acts on.
struct ActingForce {
  Vec2 point, force;
};

/// Integrals over a block of a stress (xx, yy, xy) times x and times y: 3 x 2.
using StressMoments = Eigen::Matrix<double, Tensors::RowsAtCompileTime, 2>;

/// Moments of any stress in equilibrium with these forces and a uniform force `body` per volume: six
/// quadratic displacements have the six linear strains, and the work of the forces on them is that of the
/// stress. Forces that are not balanced are taken to accelerate the block as a rigid one.
/// \param[in] rule  of the block, of degree 3 at least; all positions are from its centroid
StressMoments moments_of_forces(const polyfem::PolygonRule& rule, std::span<const ActingForce> forces,
                                const Vec2& body);

/// Moments of stresses given at the points of a rule.
StressMoments moments_of_stresses(const polyfem::PolygonRule& rule, const TensorsRef& stress);

/// The energy of the linear stress that has these moments, J per m.
double energy_of_moments(const polyfem::PolygonRule& rule, const Mat3& compliance,
                         const StressMoments& moments);

/// The energy of the part of that stress that bends the block, J per m: stress along its long axis, linear
/// across it. The compliance must be that of an isotropic material.
double energy_of_bending(const polyfem::PolygonRule& rule, const Mat3& compliance,
                         const StressMoments& moments);

}  // namespace ddacontact
