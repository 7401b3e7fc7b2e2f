/// \file The blocks that take part in steps while others sleep.
#pragma once

#include <ddacontact/block/system_part.hpp>
#include <ddacontact/time/motion_limits.hpp>
#include <ddacontact/time/sleeping.hpp>
#include <ddacontact/time/trial_step.hpp>

#include <optional>
#include <span>
#include <vector>

namespace ddacontact {

/// Blocks that sleep take no part in a step: its participants and contacts are those of a part of the whole,
/// with what rests near it. Between steps the participants are the whole.
class SleepingBlocks {
 public:
  /// \param[in,out] participants  at first the whole
  /// \param[in,out] contacts      of those that take part
  /// \param[in] properties        of the contacts of the whole
  /// \param[in] trial             made anew for the blocks that take part when these change
  SleepingBlocks(Participants& participants, std::vector<ContactRecord>& contacts,
                 const ContactProperties& properties, MotionLimits& limits, TrialStep& trial);

  /// While it lives a step is made: the participants are the part. What the step does to them is lost at its end
  /// unless it is written before.
  class WhileStepping {
   public:
    explicit WhileStepping(SleepingBlocks& sleepers);
    ~WhileStepping();
    WhileStepping(const WhileStepping&) = delete;
    WhileStepping& operator=(const WhileStepping&) = delete;

   private:
    SleepingBlocks& sleepers_;
  };

  /// Writes what has become of the participants into the whole.
  void write();

  bool is_asleep(int b) const { return sleeping_.is_asleep(b); }
  int n_asleep() const { return sleeping_.n_asleep(); }
  /// State of the sleeping mechanism, and its restoration.
  SleepRecord record() const;
  void restore(const SleepRecord& record);
  /// Makes the present state the one that `discard` returns to.
  void accept() { before_.reset(); }
  /// Puts the blocks to sleep again that slept after the last accepted substep.
  void discard();

  /// Puts the islands to sleep, velocities 0, that have rested enough by the end of the substep just made;
  /// false: none. They take part until `regroup`.
  bool fall_asleep(double dt);
  /// Divides blocks and contacts anew into those that take part and those that do not.
  /// \param[in] around  see SleepRecord; null: to be made
  void regroup(const std::vector<Box>* around = nullptr);
  /// Wakes the islands whose loads or supports change within the next substep; false: none.
  bool wake_changing(double dt);
  /// Wakes the islands that supports in motion may reach, and looks anew for what is near the blocks awake
  /// when they may leave where that was done. Returns how far from each block contacts are to be looked for.
  /// Valid until the next call.
  /// \param[in] margin_scale  see MotionLimits::search_margin
  const std::vector<double>& look_around(double dt, double margin_scale);
  /// Wakes the sleepers that are hit in a trial; false: none.
  bool wake_hit(const TrialSolution& solution);
  void wake_all();

  /// Contacts of the whole; those of sleeping blocks are as they were.
  const std::vector<ContactRecord>& contacts() const;
  /// The contacts of the part have changed.
  void contacts_changed() { all_contacts_known_ = false; }
  /// The number in the whole of a block of a step.
  int in_whole(int b) const { return whole_takes_part() ? b : asleep_->part->blocks()[b]; }
  /// Numbers in the whole of all blocks of a step; empty: the whole takes part.
  std::span<const int> in_whole() const {
    return asleep_ ? std::span<const int>(asleep_->part->blocks()) : std::span<const int>{};
  }
  /// Elastic energy, J per m, and number of closed contacts outside the part.
  double elastic_energy() const { return asleep_ ? asleep_->elastic_outside : 0; }
  int n_closed() const { return asleep_ ? asleep_->n_closed : 0; }
  /// Writes the forces of supports in a step to those of the whole, with those from sleepers, N per m.
  void spread_reactions(const Points& of_step, Points& of_whole) const;

 private:
  bool may_sleep() const;
  /// The blocks that may not fall asleep, whatever their speed: their contacts, loads or supports change.
  std::vector<char> find_restless(double dt) const;
  bool wake(int b);
  void remember();
  /// The contacts of a step with the numbers of the whole.
  std::vector<ContactRecord> contacts_in_whole() const;
  /// Takes stock of what sleeps.
  void survey();
  /// Makes the part of the blocks that are awake and what is near them.
  void form_part(const std::vector<Box>* around);
  bool whole_takes_part() const { return participants_.blocks == whole_.blocks; }
  /// Makes the part, or the whole, the participants, in the state that the others were in.
  void pass_to_part();
  void pass_to_whole();
  const BlockSystem& blocks() const { return *participants_.blocks; }
  BlockState& state() const { return *participants_.state; }

  const Participants whole_;
  Participants& participants_;
  std::vector<ContactRecord>& contacts_;
  const ContactProperties& properties_;
  MotionLimits& limits_;
  TrialStep& trial_;
  Sleeping sleeping_;
  std::optional<SleepRecord> before_;  ///< after the last accepted substep, if it is another now

  /// Data of the whole beside the part, while someone sleeps.
  struct Asleep {
    std::optional<BlockSystem::Part> part;
    std::vector<ContactRecord> contacts;  ///< without a block that is awake; numbers of the whole
    std::vector<Box> boxes;               ///< of all blocks, valid for those at rest
    std::vector<Box> around;              ///< see SleepRecord
    std::vector<double> elastic;          ///< energy of each block at rest, J per m
    double elastic_of_contacts = 0;       ///< energy in the springs of `contacts`, J per m
    double elastic_outside = 0;           ///< energy of all outside the part, J per m
    Points reactions;  ///< of supports to those who sleep, 2 x all points; only of wholly held blocks
    /// A function of time on a block.
    struct Watched {
      int block;
      const TimeFunction* function;  ///< of a load or a support
    };
    std::vector<Watched> watched;  ///< loads and supports of sleepers that may change
    int n_closed = 0;              ///< of `contacts`
  };
  std::optional<Asleep> asleep_;
  bool in_step_ = false;
  mutable std::vector<ContactRecord> all_contacts_;  ///< made when asked for, while someone sleeps
  mutable bool all_contacts_known_ = false;
};

}  // namespace ddacontact
