/// \file One step in the blocks' motions: free velocities, the contact problem, and where it leads.
///
/// Velocities s = (vc, omega, q') of a block are those in the middle of a step; impulses act over the time h
/// between two middles, on the shape at the start:
///     A (s - s_free) = H' p,       A = diag(m, m, I, 1 + h dt w^2),
/// deformation by backward Euler. Blocks with prescribed displacements are solved for those of their own unknowns
/// that are free. The geometry of contacts and supports is that at the end of the step: what the straight motion
/// misses is added to their rates, and the problem is solved again.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/block/modal_shape.hpp>
#include <ddacontact/contact/contact.hpp>
#include <ddacontact/core/options.hpp>
#include <ddacontact/solver/contact_solution.hpp>

#include <string>
#include <vector>

namespace ddacontact {

/// What a step is made of beside blocks and contacts.
struct ModalStepRule {
  double dt = 0;            ///< s
  double impulse_time = 0;  ///< h: from the middle of the step before to that of this one, s
  bool is_static = false;   ///< begins at rest; bonds break within the step
  RayleighDamping damping;
  double gap_tolerance = 1e-6;      ///< penetration allowed at the end of the step, of the block size
  double residual_tolerance = 1e-8;  ///< of the contact problem
};

/// What a step does to the energies, J per m, each from its own definition.
struct StepWork {
  double gravity = 0;    ///< change of the potential
  double external = 0;   ///< work of loads and supports
  double friction = 0;   ///< taken by friction
  double damping = 0;    ///< taken by damping, and by contacts that end an approach
  double pushed_out = 0;  ///< put in by contacts that push penetration out
  double scheme = 0;     ///< taken by the scheme; the change of kinetic energy is still to be taken off
};

/// The forces on a block at the end of a step, for the verdict on its balance, N per m.
struct BlockForceSum {
  double resultant = 0;  ///< |force| or |moment| / size, the larger: mass times acceleration
  double largest = 0;    ///< of weight, loads and reactions; contact forces are the contacts'
};

/// How a step was solved.
enum class ModalStepStatus {
  solved,
  no_balance,   ///< the contact problem was not solved to its tolerance
  penetrating,  ///< the geometry at the end did not come within its tolerance
  not_finite
};

/// A solved step.
struct ModalSolution {
  ModalStepStatus status = ModalStepStatus::not_finite;
  VectorXd modal_velocity;   ///< s of all blocks
  VectorXd displacement;     ///< of all unknowns, m
  VectorXd velocity;         ///< of all unknowns on the shape at the start, m/s
  VectorXd reaction;         ///< of the held unknowns, in their order, N per m
  StepWork work;
  std::vector<BlockForceSum> forces;  ///< of all blocks
  ContactSolverCounts counts;
  double relative_residual = 0;
  double force_scale = 0;  ///< the largest sum of the magnitudes of forces on a block, N per m
  int geometry_rounds = 0;
  int worst_contact = -1;  ///< nearest to the trouble; -1: none
};

/// Solves steps of a system of blocks that all have motions (Block::modal_shape).
class ModalStep {
 public:
  explicit ModalStep(const BlockSystem& blocks) : blocks_(blocks) {}

  /// Solves the step from `state` and writes forces, gaps and states into the contacts.
  /// \param[in] warm  the contacts' normal and shear are those of a solution nearby; else those of their history
  ModalSolution solve(const BlockState& state, const ModalStepRule& rule, std::vector<Contact>& contacts,
                      bool warm);
  /// The state after the solved step; `next` holds that before it.
  static void advance(const BlockSystem& blocks, const ModalStepRule& rule, const VectorXd& modal_velocity,
                      BlockState& next);

 private:
  const BlockSystem& blocks_;
};

}  // namespace ddacontact
