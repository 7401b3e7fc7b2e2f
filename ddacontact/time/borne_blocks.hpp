/// \file Where blocks that contacts bear begin a step.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/contact/contact.hpp>

#include <vector>

namespace ddacontact {

/// Lets blocks that contacts bear, and that move no faster than gravity would make them in the step, start
/// from where they would go on to: next to where they end, as the free path under gravity is not.
/// \param[in,out] d  displacements of all unknowns that the step begins with, of free paths before
void start_borne_blocks(const BlockSystem& blocks, const std::vector<Contact>& contacts,
                        const StepStart& start, VectorXd& d);

}  // namespace ddacontact
