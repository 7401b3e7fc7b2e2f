/// \file Counts of events that make a run's results doubtful: no step is refused for them.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/contact/contact.hpp>

#include <span>
#include <vector>

namespace ddacontact {

/// Strain beyond which linear elasticity is doubtful: Green's and the engineering strain differ by half of
/// it.
constexpr double large_strain = 0.05;

/// A substep that was accepted.
struct SeenStep {
  const BlockSystem& blocks;
  const BlockState& state;               ///< at its end
  const VectorXd& d;                     ///< its displacements
  const std::vector<Contact>& contacts;  ///< as it left them
  double dt = 0, time = 0;               ///< s; the time at its end
  bool has_velocities = false;           ///< it is not static
  bool is_first = false;                 ///< of the run: no contact has a state before it
  std::span<const int> in_whole;         ///< of each block, its number in the run; empty: the same
};

/// Looks at every accepted substep for what makes results doubtful:
/// - a block in contact moves by more than a tenth of its size: contacts are linearized at one position of
///   its path. (Flight is exact whatever the step.)
/// - an edge of a block in contact is longer or shorter by more than a twentieth than at the start:
///   elasticity is linear, for small strains.
/// - contacts of most blocks change their state, in more than a tenth of all substeps. (A first loading or a
///   pillar taken out does so too, but once or twice.)
/// - friction-induced vibration: contacts of a sliding block change their state again and again, in substeps
///   shorter than a pressure wave takes through the block. Longer ones damp its vibrations, in shorter ones
///   friction feeds them, and the block does not slide as a rigid one does.
/// - corners caught on steps of joints that were flush.
/// Energy that rises, or is pushed out at once, is told from the ledger. All of it is part of what a run carries
/// on; `warnings_of` words it.
struct RunWarnings {
  explicit RunWarnings(int n_blocks = 0) : slid(n_blocks, 0), unsteady(n_blocks, 0) {}

  void note(const SeenStep& step);

  /// Calls visit with every number, and visit.list for those of the blocks.
  template <class Warnings, class Visit>
  static void visit_numbers(Warnings& warnings, Visit&& visit) {
    for (auto* sighting : {&warnings.far, &warnings.strained, &warnings.changed, &warnings.caught}) {
      visit(sighting->substeps);
      visit(sighting->first_time);
      visit(sighting->largest);
      visit(sighting->block);
    }
    for (auto* counts : {&warnings.slid, &warnings.unsteady})
      visit.list(*counts, [&](auto& count) { visit(count); });
  }

  /// How often something was met, and where it was worst.
  struct Sighting {
    long substeps = 0;      ///< in which this was met
    double first_time = 0;  ///< at the end of the first of them, s
    double largest = 0;     ///< of what is measured, in these substeps
    int block = -1;         ///< the block of that value; -1: of no block

    void add(double value, int of_block, double time);
  };
  Sighting far;                      ///< largest motion of a block over its size
  Sighting strained;                 ///< largest strain of an edge
  Sighting changed;                  ///< part of the blocks in contact whose contacts changed
  Sighting caught;                   ///< the first block that a step in a joint held; nothing is measured
  std::vector<long> slid, unsteady;  ///< of each block: substeps in which it slid; of these, with a change
};

}  // namespace ddacontact
