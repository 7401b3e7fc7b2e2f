/// \file What a contact is for one of its blocks, in packed vectors.
#pragma once

#include <ddacontact/solver/block_groups.hpp>

namespace ddacontact {

/// Of the gap and of the slip.
struct GapSlip {
  double gap = 0, slip = 0;
};

/// Coefficients of the gap and of the slip for two unknowns of a block that follow one another, the first of
/// them at an even place.
struct SideEntry {
  using Two = Eigen::Matrix<double, 2, 1, Eigen::DontAlign>;
  Two gap, slip;
  int place;  ///< of the first one in the block
};

/// How a side's gap and slip change with x of the block.
inline GapSlip change_of(const SideEntry* entries, int n, const double* x) {
  Vec2 gap = Vec2::Zero(), slip = Vec2::Zero();
  for (const SideEntry* entry = entries; entry < entries + n; ++entry) {
    const Eigen::Map<const Vec2> of_place(x + entry->place);
    gap += entry->gap.cwiseProduct(of_place);
    slip += entry->slip.cwiseProduct(of_place);
  }
  return {gap.sum(), slip.sum()};
}

/// The entries of a contact for the block with these unknowns. Returns how many.
inline int find_entries(const ContactTerm& term, const BlockGroups& groups, const Range& unknowns,
                        SideEntry* entries) {
  const std::span<const int> u = term.gap.unknowns();
  const bool sheared = term.slip.unknowns().size() == u.size();
  int count = 0;
  for (std::size_t k = 0; k < u.size(); ++k) {
    const int place = groups.place(u[k]) - unknowns.first;
    if (place < 0 || place >= unknowns.count) continue;
    int e = 0;
    while (e < count && entries[e].place != (place & ~1)) ++e;
    if (e == count) entries[count++] = {Vec2::Zero(), Vec2::Zero(), place & ~1};
    entries[e].gap[place & 1] = term.gap.coefficients()[k];
    if (sheared) entries[e].slip[place & 1] = term.slip.coefficients()[k];
  }
  return count;
}

}  // namespace ddacontact
