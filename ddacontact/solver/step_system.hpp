/// \file The equilibrium of one step, Eq. (13), (28), (29): forces that are left over, and what they move.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/contact/contact.hpp>
#include <ddacontact/solver/friction_problem.hpp>
#include <ddacontact/solver/quiet_face.hpp>
#include <ddacontact/solver/step_bolt.hpp>

#include <vector>

namespace ddacontact {

/// Residual of the balance of forces: r = internal and inertial forces - external and contact forces.
struct Residual {
  VectorXd force;             ///< r of every unknown; at a prescribed one it is the reaction
  VectorXd external;          ///< on every unknown: loads, gravity, contacts, springs at fixed points
  double largest = 0;         ///< over the free unknowns, forces (moments over the block's size), N per m
  double scale = 0;           ///< the largest sum over a block of the magnitudes of the forces on it, N per m
  double round_off = 0;       ///< bound of the round-off in r, N per m
  double block_relative = 0;  ///< the largest part of the forces on a block that is left: its sum over the
                              ///< free unknowns, less the round-off bound of each, over the force sum
  int worst_block = -1;       ///< that `block_relative` is of; -1: all are below their bounds
  double over_round_off = 0;  ///< the largest over the free unknowns over the round-off bound of its block

  bool balanced(double tolerance) const { return largest <= tolerance * scale + round_off; }
};

/// Whether the step may be accepted; if it is not settled, it is cut.
enum class SolutionStatus {
  settled,             ///< the residual passes, states agree, penetration is below its tolerance
  friction_unsettled,  ///< open and closed agree; stick and slip, or the size of friction, do not
  states_unsettled,    ///< some contact is open that should be closed, or closed that should be open
  forces_unsettled,    ///< the residual does not pass
  penetrating,         ///< the residual passes, penetration stays above its tolerance
  not_positive_definite,
  not_finite
};

/// (13) of one step: measures residuals, assembles and factorizes their derivative.
class StepSystem {
 public:
  explicit StepSystem(BlockSystem& blocks);

  /// Begins a step of all blocks: their inertia (26), (27), and the loads.
  /// \param[in] fixed_point_stiffness  of the springs that hold vertices of six-unknown blocks
  void set_step(const BlockState& state, const StepStart& start, double fixed_point_stiffness);

  /// The length of the step, s.
  double dt() const { return dt_; }
  const StepRule& rule() const { return rule_; }
  /// The step's displacements of the prescribed degrees of freedom, zero elsewhere.
  const VectorXd& prescribed() const { return prescribed_; }
  /// The same, and elsewhere those of blocks without forces: where a solution starts.
  VectorXd free_path() const;
  /// Residual of displacements d when the contacts exert these forces.
  /// \param[in] terms  of the contacts: their gradients are what forces act along
  void compute_residual(const VectorXd& d, const std::vector<Contact>& contacts,
                        const std::vector<ContactTerm>& terms, const std::vector<ContactForce>& forces,
                        Residual& residual) const;
  /// The sum of the magnitudes of the forces on a block when the residual was computed last, N per m;
  /// infinity where it does not change.
  double sum_of_forces(int block) const { return work_.sums[block].sum; }
  /// Where d leads the unknowns to, see Block::displacement; d is changed so that prescribed ones are where
  /// they should be.
  VectorXd displacement(VectorXd& d) const;
  /// Makes the matrix anew for the blocks displaced by d.
  void linearize(const VectorXd& d);
  /// d += change, the rotations of free blocks carried out as such, see Block::add_change; less of it when a
  /// block would move further than a part of its size: what is linear holds for small changes.
  void move(const VectorXd& change, VectorXd& d) const;
  /// The matrix, its factor and what is solved with it.
  FrictionProblem& problem() { return problem_; }
  const FrictionProblem& problem() const { return problem_; }
  /// Of every unknown, see Block::unknown_lengths.
  const VectorXd& unknown_lengths() const { return unknown_lengths_; }
  BlockSystem& blocks() { return blocks_; }
  const BlockSystem& blocks() const { return blocks_; }
  /// How far d moves the block at most, m.
  double largest_motion(int block, const VectorXd& d) const;
  double size_of(int block) const { return blocks_.block(block).size(); }
  /// The stiffness of a vertex against displacements along a unit normal, with the inertia of the step: how
  /// much force moves it while the rest of its block is held; infinity when it is held itself.
  double vertex_stiffness(int block, int vertex, const Vec2& normal) const;

  /// Springs that hold vertices of six-unknown blocks: displacement from where they should be.
  struct FixedPointSpring {
    int fixed_vertex;  ///< index in BlockSystem::fixed_vertices
    int axis;
    AffineForm form;
    double target_change;  ///< of the prescribed displacement within the step
  };
  const std::vector<FixedPointSpring>& fixed_point_springs() const { return fixed_point_springs_; }
  double fixed_point_stiffness() const { return fixed_point_stiffness_; }
  /// Forces of the dashpots of quiet faces on all unknowns for displacements d.
  VectorXd quiet_forces(const VectorXd& d) const;
  /// Forces of the bolts on all unknowns at d.
  VectorXd bolt_forces(const VectorXd& d) const;
  /// The bolts that act, as d has them.
  const std::vector<StepBolt>& bolts_at(const VectorXd& d) const;
  /// Forces of all unknowns within the step: of loads (21), (23) other than gravity, and of gravity.
  const VectorXd& load_forces() const { return load_forces_; }
  const VectorXd& gravity_forces() const { return gravity_forces_; }

 private:
  /// Of the forces on a block: what they leave over, their sum, and what round-off may leave.
  struct Sums {
    double largest, left, sum, round_off;
  };
  /// Of an active block: the sum of the magnitudes of all forces but those of contacts and holding springs,
  /// and the furthest that an unknown moves.
  struct OwnSums {
    double forces, furthest;
  };
  /// What residuals have in common: thousands are computed in a step, many at the same displacements with
  /// other contact forces, and none allocates.
  struct Workspace {
    std::vector<StepBolt> bolts;    ///< those that act, as the displacements evaluated last have them
    VectorXd own_at, own_forces;    ///< displacements, empty: none; elastic, inertia's and damping there
    std::vector<OwnSums> own_sums;  ///< there, of the active blocks
    VectorXd magnitude, stiffest;   ///< of the forces on each block, and of what they come from
    std::vector<Sums> sums;         ///< of all blocks
  };
  /// Counts a force on a block, and the stiffness it comes from.
  void add_force_on(int block, double magnitude, double stiffness) const;
  /// Bolts act along their segments at the end of a static step, and of one with half steps in which tension
  /// turns a block by more than the start's segments are stable for: the swaying of two blocks by (T / l)
  /// dt^2 of half their mass, 4 times that where they turn too, has the limit of leapfrog, (omega dt)^2 = 4.
  void take_stable_directions();
  /// Adds the forces of holding springs, quiet faces and bolts.
  void add_fixtures(const VectorXd& d, VectorXd& external) const;
  /// Adds the own forces of the active block a, and sums up.
  Sums sum_up(int a, VectorXd& force) const;
  /// What is left over, from the sums of all blocks.
  void measure(Residual& residual) const;
  /// Makes what follows from displacements alone, unless it is there.
  void find_own_forces(const VectorXd& d) const;

  BlockSystem& blocks_;
  std::vector<int> active_;         ///< blocks that may change
  std::vector<int> assembled_;      ///< blocks that have matrices: these and, where requested, fixed ones
  std::vector<int> first_element_;  ///< of the matrix, of each of those
  VectorXd unknown_lengths_;
  FrictionProblem problem_;
  VectorXd diagonal_;  ///< of the matrix without contacts, of every unknown
  std::vector<FixedPointSpring> fixed_point_springs_;
  std::vector<StepQuietFace> quiet_faces_;
  double fixed_point_stiffness_ = 0;
  double dt_ = 0;
  StepRule rule_;
  VectorXd prescribed_, load_forces_, gravity_forces_;
  mutable Workspace work_;
};

}  // namespace ddacontact
