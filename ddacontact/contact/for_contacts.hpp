/// \file Loops over contacts that threads share, with the same result for any number of them.
#pragma once

#include <ddacontact/core/types.hpp>
#include <polyfem/core/parallel.hpp>

#include <cstddef>

namespace ddacontact {

/// Calls work(c) for c = 0 .. n_contacts - 1: what it writes must belong to contact c alone.
void for_contacts(std::size_t n_contacts, const auto& work) {
  constexpr Index grain = 512;
  polyfem::for_ranges(static_cast<Index>(n_contacts), grain, [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) work(static_cast<std::size_t>(c));
  });
}

}  // namespace ddacontact
