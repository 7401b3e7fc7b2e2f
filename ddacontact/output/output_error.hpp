/// \file Thrown when a result cannot be written.
#pragma once

#include <ddacontact/core/types.hpp>

namespace ddacontact {

class OutputError : public Error {
 public:
  using Error::Error;
};

}  // namespace ddacontact
