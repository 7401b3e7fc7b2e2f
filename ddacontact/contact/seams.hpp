/// \file Friction where two blocks with different joints end at one place on the face of a third.
#pragma once

#include <ddacontact/contact/contact_properties.hpp>

#include <vector>

namespace ddacontact {

/// Gives the corners of two held blocks that meet on an edge of a third, with joints of different friction,
/// the mean of both by the lengths that they stand for. Together they bear what presses there, and only
/// round-off says how much each does; of blocks that move their own equilibrium does.
/// \param[in,out] contacts  of the start of a step
void share_friction_at_seams(const BlockSystem& blocks, const BlockState& state,
                             const ContactProperties& properties, std::vector<Contact>& contacts);

}  // namespace ddacontact
