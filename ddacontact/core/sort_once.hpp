/// \file Lists as sets.
#pragma once

#include <algorithm>
#include <vector>

namespace ddacontact {

/// Ascending, each entry once.
template <class T>
void sort_once(std::vector<T>& entries) {
  std::ranges::sort(entries);
  entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
}

}  // namespace ddacontact
