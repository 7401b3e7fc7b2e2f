/// \file Matrices of a step that all congruent blocks share.
#pragma once

#include <ddacontact/block/step_start.hpp>
#include <ddacontact/core/types.hpp>

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

namespace ddacontact {

/// The tangents of a shape's cells in a step by this rule and of this length, not turned.
struct StepMatrices {
  StepRule rule;
  double dt = 0;
  std::vector<MatrixXd> tangents;

  bool are_for(const StepRule& of_rule, double of_dt) const { return rule == of_rule && dt == of_dt; }
};

/// Those that were last requested of a shape. Any thread may ask.
class LastStepMatrices {
 public:
  using Make = std::function<std::vector<MatrixXd>(const StepRule& rule, double dt)>;
  std::shared_ptr<const StepMatrices> get(const StepRule& rule, double dt, const Make& make) {
    const std::lock_guard lock(mutex_);
    if (!last_ || !last_->are_for(rule, dt))
      last_ = std::make_shared<const StepMatrices>(StepMatrices{rule, dt, make(rule, dt)});
    return last_;
  }

 private:
  std::mutex mutex_;
  std::shared_ptr<const StepMatrices> last_;
};

}  // namespace ddacontact
