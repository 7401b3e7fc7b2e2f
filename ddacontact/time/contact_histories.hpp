/// \file Histories that contacts hand on from a step to the next.
#pragma once

#include <ddacontact/contact/contact_builder.hpp>
#include <ddacontact/time/energy_ledger.hpp>

#include <vector>

namespace ddacontact {

/// Counts of the contacts at the end of a step.
struct ContactEnds {
  long closed = 0, broken_bonds = 0;
  double deepest = 0;  ///< penetration, m
};

/// Writes the histories of the contacts at the end of an accepted step: forces, dilation, bonds and gaps that
/// count as none.
/// \param[in] next            where the blocks are then
/// \param[in,out] energy      the work of dilation is taken from that of friction
ContactEnds end_histories(const BlockSystem& blocks, const BlockState& next, const StepRule& rule,
                          const ContactProperties& properties, std::vector<Contact>& contacts,
                          Energy& energy);

}  // namespace ddacontact
