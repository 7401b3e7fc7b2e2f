/// \file The law of a bolt: forces of its segments by the elongations of the rock between its nodes.
///
/// Bar and bond are springs whose force follows their elongation, up to a constant bound (ideal
/// plasticity). With u the elongations of the rock and s the slips of a grouted bar at its nodes, towards the
/// last one,
///     N_k = E A / L_k (u_k + s_k+1 - s_k - plastic_k),      |N_k| <= yield,  N_k >= -buckling,
///     T_i = bond stiffness l_i (s_i - plastic_i),            |T_i| <= bond strength l_i,
/// and the slips are those that balance the bar, N_i - N_i-1 = T_i: the minimum of a convex potential, as
/// contacts with a constant bound of friction have. An anchored bar has no slips.
#pragma once

#include <ddacontact/block/bolt.hpp>

namespace ddacontact {

/// Numbers of one bolt in BlockState::bolts.
using BoltNumbers = Eigen::Ref<const VectorXd>;

/// Response of a bolt to elongations of the rock.
struct BoltForces {
  VectorXd axial;    ///< N of every segment, N per m, tension positive; 0 of those that have torn or are gone
  VectorXd stretch;  ///< of the bar in every segment: elongation of the rock and slips at its ends, m
  VectorXd slip;     ///< of a grouted bar at its nodes, m
  VectorXd bond;     ///< T of its nodes, on the rock towards the last node, N per m
  double stored = 0;   ///< energy in bar and bond, J per m
  MatrixXd stiffness;  ///< derivative of `axial` by the elongations: symmetric, no eigenvalue below 0
};

/// \param[in] elongation  of the rock since the bolt was installed, m, a number a segment
BoltForces bolt_forces(const Bolt& bolt, const BoltNumbers& numbers, const VectorXd& elongation);

/// Losses of a bolt in a step.
struct BoltLosses {
  double dissipated = 0;  ///< by yielding of bar and bond and by segments that tear, J per m
  bool tears = false;
};
/// Ends a step with these elongations: plastic ones and slips remain, and segments that are
/// strained beyond the rupture strain tear.
BoltLosses follow(const Bolt& bolt, const VectorXd& elongation, VectorOut numbers);

/// Energy of all bolts that act, J per m.
double bolt_energy(const BlockSystem& blocks, const BlockState& state);

}  // namespace ddacontact
