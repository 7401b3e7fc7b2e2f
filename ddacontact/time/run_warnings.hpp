/// \file What a run met that makes its results doubtful, counted: no step is refused for it.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/contact/contact.hpp>
#include <ddacontact/time/energy_ledger.hpp>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace ddacontact {

/// What makes results doubtful.
enum class Doubt {
  far_in_one_step,    ///< a block in contact moved further than a tenth of its size in one substep
  contacts_changed,   ///< contacts of most blocks changed their state in one substep
  friction_vibration  ///< contacts of a sliding block change their state in most substeps
};
inline constexpr int n_doubts = 3;

/// How often it was met, and where it was worst.
struct Sighting {
  long substeps = 0;      ///< in which it was met
  double first_time = 0;  ///< at the end of the first of them, s
  double largest = 0;     ///< of what is measured, in these substeps
  int block = -1;         ///< whose it was; -1: of no block
};

/// A substep that was accepted.
struct SeenStep {
  const BlockSystem& blocks;
  const VectorXd& d;
  const std::vector<Contact>& contacts;  ///< as the substep left them
  double time = 0;                       ///< at its end, s
  bool first = false;                    ///< of the run: no contact has a state before it
  std::span<const int> in_whole;         ///< of each block, its number in the run; empty: the same
};

/// Looks at every accepted substep. All of it is part of what a run carries on.
class RunWarnings {
 public:
  explicit RunWarnings(int n_blocks = 0) : slid_(n_blocks, 0), changed_(n_blocks, 0) {}

  void look(const SeenStep& step);
  /// A line for each doubt that is worth telling.
  /// \param[in] names     of all blocks
  /// \param[in] substeps  accepted in the run
  std::vector<std::string> texts(const std::vector<std::string>& names, long substeps,
                                 const EnergyLedger& energy) const;
  const Sighting& of(Doubt doubt) const { return sightings_[static_cast<int>(doubt)]; }

  /// Calls visit with every number, and visit.list for those of the blocks.
  template <class Warnings, class Visit>
  static void visit_numbers(Warnings& warnings, Visit&& visit) {
    for (auto& sighting : warnings.sightings_) {
      visit(sighting.substeps);
      visit(sighting.first_time);
      visit(sighting.largest);
      visit(sighting.block);
    }
    for (auto* counts : {&warnings.slid_, &warnings.changed_})
      visit.list(*counts, [&](auto& count) { visit(count); });
  }

 private:
  std::array<Sighting, n_doubts> sightings_;
  std::vector<long> slid_, changed_;  ///< of each block: substeps in which it slid; of these, with a change
};

}  // namespace ddacontact
