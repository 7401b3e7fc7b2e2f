/// \file The memory that there is.
#pragma once

#include <optional>

namespace ddacontact {

/// Bytes that this program may still take: what the system has available, the limits of its control group and
/// of its address space, whichever is least; nothing where none of them is known.
std::optional<double> available_memory();

}  // namespace ddacontact
