#include <polyfem/assembly/front_tree.hpp>

#include <cholmod.h>

#include <algorithm>
#include <cassert>

namespace polyfem {

FrontTree::FrontTree(const cholmod_factor_struct& L)
    : super_(static_cast<const int*>(L.super)),
      first_row_(static_cast<const int*>(L.pi)),
      first_entry_(static_cast<const int*>(L.px)),
      row_(static_cast<const int*>(L.s)),
      order_(static_cast<const int*>(L.Perm)),
      n_entries_(L.xsize),
      group_of_(L.n),
      n_children_(L.nsuper),
      places_(L.ssize) {
  assert(L.is_super);
  for (int s = 0; s < n_groups(); ++s) std::fill_n(group_of_.begin() + first_column(s), n_columns(s), s);
  std::vector<int> place(L.n), next(L.nsuper, -1), last(L.nsuper, -1);
  for (int s = 0; s < n_groups(); ++s) {
    const std::span<const int> of_front = rows(s);
    for (std::size_t k = 0; k < of_front.size(); ++k) place[of_front[k]] = static_cast<int>(k);
    for (int child = last[s]; child >= 0; child = next[child])
      for (int k = first_row(child) + n_columns(child); k < first_row(child + 1); ++k)
        places_[k] = place[row_[k]];
    if (above(s) < 0) continue;
    ++n_children_[above(s)];
    next[s] = last[above(s)];
    last[above(s)] = s;
  }
  std::vector<std::ptrdiff_t> squares;
  std::ptrdiff_t waiting = 0;
  for (int s = 0; s < n_groups(); ++s) {
    const std::ptrdiff_t square = static_cast<std::ptrdiff_t>(n_below(s)) * n_below(s);
    most_waiting_ = std::max(most_waiting_, waiting + square);
    for (int k = 0; k < n_children(s); ++k) {
      waiting -= squares.back();
      squares.pop_back();
    }
    if (square > 0) squares.push_back(square);
    waiting += square;
  }
}

std::ptrdiff_t FrontTree::place_of(int row, int column) const {
  const int s = group_of(column);
  const std::span<const int> of_front = rows(s);
  const std::ptrdiff_t at = std::ranges::lower_bound(of_front, row) - of_front.begin();
  assert(of_front[at] == row);
  return first_entry_[s] + (column - first_column(s)) * std::ssize(of_front) + at;
}

double FrontTree::memory() const {
  return sizeof(int) * static_cast<double>(group_of_.size() + n_children_.size() + places_.size());
}

}  // namespace polyfem
