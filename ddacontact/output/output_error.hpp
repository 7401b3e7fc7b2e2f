/// \file Thrown when a result cannot be written, or read back.
#pragma once

#include <ddacontact/core/types.hpp>

namespace ddacontact {

/// A result cannot be written.
using OutputError = polyfem::FileError;

}  // namespace ddacontact
