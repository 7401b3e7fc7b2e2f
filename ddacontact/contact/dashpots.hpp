/// \file Damping of closed contacts.
#pragma once

#include <ddacontact/contact/contact_properties.hpp>

#include <vector>

namespace ddacontact {

/// Sets `Contact::damping` for a step of length dt, s, by the `dashpot` ratios of the joints: a block that
/// moves along the normal of contacts on which it rests vibrates with that part of critical damping, whatever
/// their number. Of two blocks the one with less mass for its stiffness counts, and a free one alone beside
/// one that is held in part; 0 where supports lead both.
void set_dashpots(const BlockSystem& blocks, const ContactProperties& properties, double dt,
                  std::vector<Contact>& contacts);

}  // namespace ddacontact
