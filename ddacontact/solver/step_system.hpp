/// \file The equilibrium equations of one step, Eq. (13), (28), (29), with the contacts' springs.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/contact/contact.hpp>
#include <polyfem/assembly/pattern_matrix.hpp>

#include <vector>

namespace ddacontact {

/// How far from equilibrium: r = K d - F in the norm that open-close is judged by.
struct Residual {
  VectorXd force;      ///< of every unknown; at a held one it is the reaction
  double largest = 0;  ///< over the free unknowns, forces (moments over the block's size), N per m
  double scale = 0;    ///< the largest sum over a block of the magnitudes of the forces on it, N per m
  double floor = 0;    ///< what round-off alone may leave, N per m

  bool balanced(double tolerance) const { return largest <= tolerance * scale + floor; }
};

/// (13) of one step: assembles, factorizes and measures residuals for given contact states.
class StepSystem {
 public:
  explicit StepSystem(const BlockSystem& blocks);

  /// Springs of the contacts' forms and of the held vertices: keeps the analysis
  /// when the pattern is the same.
  void set_contacts(const BlockState& state, const std::vector<Contact>& contacts, double held_stiffness);
  /// Loads at the end of the step and the inertia terms (26), (27); `state` is the one the blocks are
  /// prepared for and `velocity` what they start with.
  void set_step(const BlockState& state, const VectorXd& velocity, double dt);

  /// The step's displacements of the held unknowns, zero elsewhere: where open-close starts.
  const VectorXd& prescribed() const { return prescribed_; }
  /// K d - F for the contacts' states: springs of closed contacts (39), (40), (47), (48), friction (52) from
  /// the penetration at d.
  void compute_residual(const VectorXd& d, const std::vector<Contact>& contacts, Residual& residual) const;
  /// Assembles and factorizes (13) for the contacts' states, unless the last factor is of the same matrix.
  [[nodiscard]] bool factorize(const std::vector<Contact>& contacts);
  /// correction = K^-1 r on the free unknowns, 0 on the held ones.
  void solve(const VectorXd& residual_force, VectorXd& correction);
  /// Of every unknown, see Block::unknown_lengths.
  const VectorXd& unknown_lengths() const { return unknown_lengths_; }

  /// Springs that hold vertices of six-unknown blocks: displacement from where they should be.
  struct HeldSpring {
    int held_vertex;  ///< index in BlockSystem::held_vertices
    int axis;
    AffineForm form;
    double target_change;  ///< of the prescribed displacement within the step
  };
  const std::vector<HeldSpring>& held_springs() const { return held_springs_; }
  double held_stiffness() const { return held_stiffness_; }
  /// Forces of all unknowns at the end of the step: of loads (21), (23) other than gravity, and of gravity.
  const VectorXd& load_forces() const { return load_forces_; }
  const VectorXd& gravity_forces() const { return gravity_forces_; }

  const polyfem::Cholesky& cholesky() const { return cholesky_; }

 private:
  const BlockSystem& blocks_;
  std::vector<int> active_;  ///< blocks that may change; element e of the matrix is block active_[e]
  VectorXd unknown_lengths_;
  polyfem::PatternMatrix matrix_;
  polyfem::Cholesky cholesky_;
  std::vector<HeldSpring> held_springs_;
  double held_stiffness_ = 0;
  double dt_ = 0;
  VectorXd velocity_, prescribed_, load_forces_, gravity_forces_, stress_forces_;
  double coordinate_ = 0;  ///< largest coordinate, for the round-off floor
  double largest_stiffness_ = 0;
  std::vector<unsigned char> factored_springs_;  ///< active springs of the last factor; empty: none
  VectorXd rhs_, solution_;

  int n_active() const { return static_cast<int>(active_.size()); }
};

}  // namespace ddacontact
