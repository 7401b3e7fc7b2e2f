/// \file What a block is told of a step before its displacements are known.
#pragma once

#include <ddacontact/core/options.hpp>
#include <ddacontact/core/types.hpp>

#include <new>

namespace ddacontact {

/// The time scheme in numbers.
struct StepRule {
  Scheme scheme = Scheme::dda;
  double beta = 0.5, gamma = 1;  ///< of the Newmark family; midpoint and decaying have an inertia of (1/2, 1)
  RayleighDamping damping;

  /// Elastic forces come from both ends of the step and act at its middle, as contact forces do.
  bool mean_forces() const { return scheme == Scheme::midpoint || scheme == Scheme::decaying; }
  /// Inertia forces are M (inertia() (d - dt v0) / dt^2 - history() a0).
  double inertia() const { return scheme == Scheme::backward_euler ? 1 : 1 / beta; }
  double history() const { return scheme == Scheme::newmark ? 1 / (2 * beta) - 1 : 0; }
  /// The share of the end in the mean of the strains at both ends of the step, less a half.
  double decay() const { return scheme == Scheme::decaying ? 0.5 : 0; }
  /// When within the step loads are taken.
  double load_time() const { return mean_forces() ? 0.5 : 1; }

  bool operator==(const StepRule& other) const {
    return scheme == other.scheme && beta == other.beta && gamma == other.gamma &&
           damping.mass == other.damping.mass && damping.stiffness == other.damping.stiffness;
  }
};

/// The scheme that the options ask for, with its numbers. Static steps of the conserving scheme, whose
/// strains would swing about equilibrium for ever, are made by the decaying one.
inline StepRule step_rule(const AnalysisOptions& analysis) {
  if (analysis.mode == Mode::statics && analysis.scheme == Scheme::midpoint)
    return {Scheme::decaying, 0.5, 1, analysis.damping};
  if (analysis.scheme == Scheme::newmark)
    return {analysis.scheme, analysis.beta, analysis.gamma, analysis.damping};
  return {analysis.scheme, 0.5, 1, analysis.damping};
}

/// Motion at the start of a step, of all unknowns.
struct StepStart {
  StepRule rule;
  double dt = 0;
  VectorXd velocity, acceleration;
  /// An impact within the step changes the velocity by `jump`; `jump_path` is `jump` times what is left of
  /// the step after it.
  VectorXd jump, jump_path;
};

/// With what forces a block resists the displacements of a step, of its own unknowns. Their storage serves
/// blocks of all sizes, one after another.
class BlockForces {
 public:
  BlockForces() = default;
  BlockForces(BlockForces&&) = default;

  void resize(Index n_unknowns) {
    if (elastic.size() == n_unknowns) return;
    if (storage_.size() < 3 * n_unknowns) storage_.resize(3 * n_unknowns);
    double* numbers = storage_.data();
    for (Forces* part : {&elastic, &inertia, &damping}) {
      new (part) Forces(numbers, n_unknowns);  // how Eigen has a Map look elsewhere
      numbers += n_unknowns;
    }
  }

  using Forces = Eigen::Map<VectorXd>;
  Forces elastic{nullptr, 0}, inertia{nullptr, 0}, damping{nullptr, 0};

 private:
  VectorXd storage_;
};

}  // namespace ddacontact
