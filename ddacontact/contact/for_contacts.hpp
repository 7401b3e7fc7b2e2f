/// \file Loops over contacts that threads share, with the same result for any number of them.
#pragma once

#include <ddacontact/core/for_all.hpp>

namespace ddacontact {

/// Calls work(c) for c = 0 .. n_contacts - 1: what it writes must belong to contact c alone.
void for_contacts(std::size_t n_contacts, const auto& work) {
  for_all(n_contacts, work);
}

}  // namespace ddacontact
