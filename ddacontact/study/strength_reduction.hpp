/// \file Factor of safety by strength reduction: tan(friction angle), cohesion and tensile strength of joints
/// divided by a factor in the last stage of a scene.
///
///     StrengthReduction reduction(scene, {0});
///     StrengthTrial trial = reduction.try_factor(1.2);
#pragma once

#include <ddacontact/scene/builder.hpp>
#include <ddacontact/study/strength_trial.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace ddacontact {

/// Whether cohesion and tensile strength of the joint outlast slip in the study, as limit equilibrium has it:
/// all of them act at once, and they are lost by opening alone. A joint with a residual friction angle stays
/// brittle: it loses them where it slips, with the rest of its friction.
bool is_ductile(const Joint& joint);

/// The strength of a joint divided by a factor.
Joint reduced(Joint joint, double factor);

/// The run stops before the trials begin.
class SettlingStopped : public Error {
 public:
  using Error::Error;
};

/// All trials start from the same settled state: that at the end of the stage before the last. A scene of one
/// part is settled first with the joints to be reduced glued, by static steps, as many as the scene has or
/// 1000. Trials begin with static steps, which let go what glue or strength bore without shaking the blocks,
/// in steps so long that inertia does not count, unless loads are yet to change or the last stage excavates,
/// builds or loads; a scene of one part that does not settle glued is settled by them.
class StrengthReduction {
 public:
  /// Makes the settled state. Throws SettlingStopped, and Error when the scene is of the method
  /// "classic", which cannot settle glued, when none of `joints` has any strength, when loads are over before a
  /// static verdict, or when no block can move.
  /// \param[in] joints  indices of those that are reduced
  StrengthReduction(const Scene& scene, std::vector<int> joints);

  /// Several threads may try factors at a time.
  /// \param[in] given_up  ends the trial, without a verdict, where it returns true; asked after every trial
  /// step
  StrengthTrial try_factor(double factor, const TrialLimits& limits = {},
                           const std::function<bool()>& given_up = {}) const;

  /// What is wrong with the settled state: it is out of balance or moves. Empty: it rests.
  const std::string& unsettled() const { return unsettled_; }
  /// Of the scene, see BuiltScene, and on its trials.
  const std::vector<std::string>& notes() const { return notes_; }
  /// As it is tried: in stages, bonds as is_ductile() says.
  const Scene& scene() const { return scene_; }

 private:
  /// \param[in] glues  the first stage is its own, with all joints glued
  void settle(bool glues);

  Scene scene_;         ///< of two stages at least
  int n_settling_ = 0;  ///< stages before the trials
  std::vector<int> joints_;
  std::optional<RunRecord> settled_;
  std::string unsettled_;
  std::vector<std::string> notes_;
};

}  // namespace ddacontact
