#include <ddacontact/solver/block_groups.hpp>

#include <polyfem/core/parallel.hpp>

#include <array>
#include <bit>

namespace ddacontact {

namespace {

constexpr Index grain = 4096;

}  // namespace

bool BlockGroups::set(FrictionProblem& problem, const std::vector<ContactTerm>& contacts) {
  const polyfem::Connectivity& unknowns = problem.unknowns();
  const std::vector<int>& equation = problem.equation();
  const auto n_matrices = static_cast<std::size_t>(unknowns.n_elements());
  std::vector<int> matrix_of(equation.size(), -1);
  std::vector<char> moves(n_matrices, 0);
  for (std::size_t e = 0; e < n_matrices; ++e) {
    const std::span<const int> of_block = unknowns.rows_of(static_cast<int>(e));
    for (int u : of_block) {
      if (equation[static_cast<std::size_t>(u)] < 0) continue;
      moves[e] = 1;
      int& matrix = matrix_of[static_cast<std::size_t>(u)];
      if (matrix >= 0) return false;
      matrix = static_cast<int>(e);
    }
    if (moves[e] && (of_block.size() > largest_block || of_block.size() % 2 != 0)) return false;
  }

  // The two blocks of each contact, and from them the contacts of each block.
  std::vector<std::array<int, 2>> pairs(contacts.size(), {-1, -1});
  std::vector<std::size_t> first(n_matrices + 1, 0);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    auto& [a, b] = pairs[c];
    for (int u : contacts[c].gap.unknowns()) {
      const int matrix = matrix_of[static_cast<std::size_t>(u)];
      if (matrix >= 0 && matrix != a) (a < 0 ? a : b) = matrix;
    }
    for (int matrix : pairs[c])
      if (matrix >= 0) ++first[static_cast<std::size_t>(matrix) + 1];
  }
  for (std::size_t e = 0; e < n_matrices; ++e) first[e + 1] += first[e];
  struct OfMatrix {
    int contact, block;
  };
  std::vector<OfMatrix> of_matrices(first.back());
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  for (std::size_t c = 0; c < contacts.size(); ++c)
    for (int side : {0, 1})
      if (pairs[c][side] >= 0)
        of_matrices[next[static_cast<std::size_t>(pairs[c][side])]++] = {static_cast<int>(c),
                                                                         pairs[c][1 - side]};

  // A group grows from a block beside the ones before, by the neighbours of those it has.
  matrices_.clear();
  std::vector<int> order(n_matrices, -1), beside;
  std::size_t seen = 0, seen_beside = 0;
  const auto add = [&](std::size_t e) {
    order[e] = static_cast<int>(matrices_.size());
    matrices_.push_back(static_cast<int>(e));
  };
  const auto is_left = [&](int e) { return e >= 0 && order[static_cast<std::size_t>(e)] < 0; };
  const auto grow = [&] {
    for (; seen < matrices_.size(); ++seen) {
      const auto of = static_cast<std::size_t>(matrices_[seen]);
      for (std::size_t k = first[of]; k < first[of + 1]; ++k) {
        const int other = of_matrices[k].block;
        if (!is_left(other)) continue;
        if (group_of(static_cast<int>(matrices_.size())) == group_of(static_cast<int>(seen)))
          add(static_cast<std::size_t>(other));
        else
          beside.push_back(other);
      }
    }
  };
  for (std::size_t e = 0; e < n_matrices; ++e) {
    if (!moves[e] || !is_left(static_cast<int>(e))) continue;
    add(e);
    grow();
    for (; seen_beside < beside.size(); ++seen_beside) {
      if (!is_left(beside[seen_beside])) continue;
      add(static_cast<std::size_t>(beside[seen_beside]));
      grow();
    }
  }

  for (int g = 0; g < n_groups(); ++g) {
    const Range blocks = group(g);
    std::sort(matrices_.begin() + blocks.first, matrices_.begin() + blocks.end());
    for (int b = blocks.first; b < blocks.end(); ++b)
      order[static_cast<std::size_t>(matrices_[static_cast<std::size_t>(b)])] = b;
  }

  first_.assign(1, 0);
  unknown_.clear();
  place_.assign(equation.size(), -1);
  first_neighbour_.assign(1, 0);
  neighbours_.clear();
  for (int matrix : matrices_) {
    for (int u : unknowns.rows_of(matrix)) {
      const bool held = equation[static_cast<std::size_t>(u)] < 0;
      if (!held) place_[static_cast<std::size_t>(u)] = static_cast<int>(unknown_.size());
      unknown_.push_back(held ? -1 : u);
    }
    first_.push_back(static_cast<int>(unknown_.size()));
    const auto e = static_cast<std::size_t>(matrix);
    for (std::size_t k = first[e]; k < first[e + 1]; ++k) {
      const auto c = static_cast<std::size_t>(of_matrices[k].contact);
      const int other = of_matrices[k].block, index = static_cast<int>(neighbours_.size());
      unsigned moved = 0;  // bits: pairs
      for (int u : contacts[c].gap.unknowns()) {
        const int place = place_[static_cast<std::size_t>(u)] - first_.end()[-2];
        if (place >= 0) moved |= 1U << (place / 2);
      }
      neighbours_.push_back({static_cast<int>(c), other < 0 ? -1 : order[static_cast<std::size_t>(other)], -1,
                             std::popcount(moved)});
      if (other < 0) continue;
      int& seen_before = pairs[c][0];  // no longer needed
      if (pairs[c][1] >= 0) {
        pairs[c] = {index, -1};
      } else {
        neighbours_.back().back = seen_before;
        neighbours_[static_cast<std::size_t>(seen_before)].back = index;
      }
    }
    first_neighbour_.push_back(neighbours_.size());
  }
  return true;
}

void BlockGroups::copy_matrix(FrictionProblem& problem, int block, Eigen::Map<MatrixXd>& to) const {
  to = problem.elements()[static_cast<std::size_t>(matrices_[static_cast<std::size_t>(block)])];
  const Range of_block = unknowns(block);
  for (int k = 0; k < of_block.count; ++k) {
    if (unknown_[static_cast<std::size_t>(of_block.first + k)] >= 0) continue;
    to.row(k).setZero();
    to.col(k).setZero();
    to(k, k) = 1;
  }
}

void BlockGroups::pack(const VectorXd& v, VectorXd& packed) const {
  packed.resize(n_unknowns());
  polyfem::for_ranges(n_unknowns(), grain, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) packed[k] = unknown_[k] < 0 ? 0 : v[unknown_[k]];
  });
}

void BlockGroups::unpack(const VectorXd& packed, VectorXd& v) const {
  v.setZero(static_cast<Index>(place_.size()));
  polyfem::for_ranges(n_unknowns(), grain, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k)
      if (unknown_[k] >= 0) v[unknown_[k]] = packed[k];
  });
}

}  // namespace ddacontact
