/// \file What integration points of a mesh remember from step to step: plastic strains, damage.
#pragma once

#include <polyfem/core/types.hpp>

#include <span>
#include <vector>

namespace polyfem {

/// States at the integration points of cells, at the end of the last step and as found meanwhile. Materials
/// go from `before` to `now` in every iteration of Newton's method, and a step that converged becomes
/// history:
///
///     History<PlasticState> history(mesh.n_cells());
///     ... history.cell(c, element.n_points()).before[q], .now[q] ...
///     if (problem.solve(t).converged) history.commit();
///
/// A step that did not converge leaves `before` as it was: the next one starts from there.
template <class State>
class History {
 public:
  /// The states of one cell, a point each.
  struct Cell {
    std::span<const State> before;
    std::span<State> now;
  };

  explicit History(int n_cells, const State& initial = State{})
      : initial_(initial), before_(static_cast<std::size_t>(n_cells)), now_(before_) {}

  /// Those of a cell, `initial` at first; good until `commit`. Cells may be asked for in parallel.
  Cell cell(int c, Index n_points) {
    std::vector<State>& before = before_.at(static_cast<std::size_t>(c));
    std::vector<State>& now = now_[static_cast<std::size_t>(c)];
    before.resize(static_cast<std::size_t>(n_points), initial_);
    now.resize(before.size(), initial_);
    return {before, now};
  }
  /// What was found last becomes what is remembered.
  void commit() { before_ = now_; }
  /// What is remembered, by cell and point; empty for cells that were not requested.
  const std::vector<std::vector<State>>& states() const { return before_; }

 private:
  State initial_;
  std::vector<std::vector<State>> before_, now_;
};

}  // namespace polyfem
