/// \file The equilibrium of one step, Eq. (13), (28), (29): forces that are left over, and what they move.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/contact/contact.hpp>
#include <ddacontact/equations/quiet_face.hpp>
#include <ddacontact/equations/step_bolt.hpp>
#include <ddacontact/solver/step_problem.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace ddacontact {

/// (13) of one step: measures residuals, assembles and factorizes their derivative.
class StepSystem : public StepProblem {
 public:
  explicit StepSystem(const BlockSystem& blocks);

  /// Begins a step of all blocks: their inertia (26), (27), and the loads.
  /// \param[in] fixed_point_stiffness  of the springs that hold vertices of six-unknown blocks
  void set_step(const BlockState& state, const StepStart& start, double fixed_point_stiffness);

  /// The length of the step, s.
  double dt() const { return dt_; }
  const StepRule& rule() const { return rule_; }
  bool is_explicit() const override { return rule_.is_explicit(); }
  const VectorXd& prescribed() const override { return prescribed_; }
  /// The step's prescribed displacements, and elsewhere those of blocks without forces: where a solution starts.
  VectorXd free_path() const;
  void compute_residual(const VectorXd& d, const std::vector<Contact>& contacts,
                        const std::vector<ContactTerm>& terms, const std::vector<ContactForce>& forces,
                        Residual& residual) const override;
  double sum_of_forces(int block) const override { return work_.sums[block].sum; }
  /// See BlockStep::displacement. Prescribed points are led to where they should be: d is changed so that
  /// they are.
  VectorXd displacement(VectorXd& d) const override;
  void linearize(const VectorXd& d) override;
  /// See BlockStep::add_change.
  void move(const VectorXd& change, VectorXd& d) const override;
  std::optional<std::vector<double>> bends(const VectorXd& d, const VectorXd& change) const override;
  double contact_stiffness(const Contact& contact) const override;
  FrictionProblem& problem() override { return problem_; }
  const FrictionProblem& problem() const { return problem_; }
  /// See Block::unknown_lengths.
  const VectorXd& unknown_lengths() const override { return unknown_lengths_; }
  const BlockSystem& blocks() const { return blocks_; }
  /// The step of a block that has matrices.
  const BlockStep& step(int b) const { return *steps_[b]; }
  /// Ends the step: see BlockStep::end. Vectors of all unknowns.
  void end(const VectorXd& d, const VectorXd& external, BlockState& next) const;
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
  /// Finds where d leads the unknowns of a block.
  void displace(int block, const VectorXd& d, VectorXd& displaced) const;
  /// How far d moves the block at most, m.
  double largest_motion(int block, const VectorXd& d) const;
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

  const BlockSystem& blocks_;
  std::vector<std::unique_ptr<BlockStep>> steps_;  ///< of all blocks that have matrices
  std::vector<int> active_;                        ///< blocks that may change
  std::vector<int> assembled_;      ///< blocks that have matrices: these and, where requested, fixed ones
  std::vector<int> first_element_;  ///< of the matrix, of each of those
  VectorXd unknown_lengths_;
  std::vector<char> moves_as_a_whole_;  ///< of all unknowns: one that by itself does not strain its block
  FrictionProblem problem_;
  /// Of the matrix without contacts, of every unknown; empty: it was not made in this step.
  VectorXd diagonal_;
  std::vector<FixedPointSpring> fixed_point_springs_;
  std::vector<StepQuietFace> quiet_faces_;
  double fixed_point_stiffness_ = 0;
  double dt_ = 0;
  StepRule rule_;
  VectorXd prescribed_, load_forces_, gravity_forces_;
  mutable Workspace work_;
};

}  // namespace ddacontact
