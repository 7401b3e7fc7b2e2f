/// \file Matrices of a step that all congruent blocks share, and a block's data at the start of its step.
#pragma once

#include <ddacontact/block/step_start.hpp>
#include <ddacontact/core/types.hpp>

#include <memory>
#include <vector>

namespace ddacontact {

struct CorotationalShape;

/// The tangents of a shape's cells in a step by this rule and of this length, not turned.
struct StepMatrices {
  StepRule rule;
  double dt = 0;
  std::vector<MatrixXd> tangents;

  bool are_for(const StepRule& of_rule, double of_dt) const { return rule == of_rule && dt == of_dt; }
};

/// Data of a corotational block at the start of its step: rule and length, and vectors of its nodes that
/// BlockMotion or CorotationalStep lays out. They are one array, as every awake block has one.
struct CorotationalStart {
  std::shared_ptr<const StepMatrices> matrices{};
  std::vector<Vec2> arrays{};

  /// Finds the matrices of a step.
  void take_matrices(const CorotationalShape& shape, const StepRule& rule, double dt);
};

}  // namespace ddacontact
