/// \file Corners that catch on joints.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/contact/contact.hpp>

#include <vector>

namespace ddacontact {

/// A block whose corner bears on one block and is pressed against the edge of the next, at a step between
/// both that was not there at the start and is lower than a hundredth of the smaller block (higher ones are
/// seen in a picture); -1: there is none. Sharp corners catch on any step above `ContactProperties::lip`.
///
/// \param[in] state  at the end of the step that left the contacts
int find_caught_block(const BlockSystem& blocks, const BlockState& state,
                      const std::vector<Contact>& contacts);

}  // namespace ddacontact
