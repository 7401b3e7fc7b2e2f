#include <polyfem/assembly/single_precision_factor.hpp>

#include <cholmod.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

namespace polyfem {
namespace {

/// In so many parts entries wait for their columns.
constexpr int n_parts = 16;

/// An entry of S K S in its row of L.
struct Entry {
  int row;
  float value;
};

/// Those of each column of L, in parts of columns that follow each other: parts that are used are let go, as
/// L takes their memory.
struct Entries {
  std::vector<int> first;  ///< of column c in all of them
  int part_size;           ///< columns
  std::vector<LargeVector<Entry>> parts;

  std::span<Entry> of_column(int c) {
    const int part = c / part_size;
    return {parts[part].data() + (first[c] - first[part * part_size]),
            static_cast<std::size_t>(first[c + 1] - first[c])};
  }
  void forget_before(int c) {
    for (int part = c / part_size - 1; part >= 0 && !parts[part].empty(); --part)
      LargeVector<Entry>().swap(parts[part]);
  }
};

/// One over the roots of the diagonal; nothing when an entry of it is not positive.
std::optional<VectorXd> scale_of(const SparseMatrix& lower) {
  VectorXd scale(lower.cols());
  for (Index c = 0; c < lower.cols(); ++c) {
    const double diagonal = lower.valuePtr()[lower.outerIndexPtr()[c]];
    if (!(diagonal > 0)) return std::nullopt;
    scale[c] = 1 / std::sqrt(diagonal);
  }
  return scale;
}

Entries in_order(const cholmod_factor_struct& L, const SparseMatrix& lower, const VectorXd& scale) {
  const int n = static_cast<int>(L.n);
  const int *const order = static_cast<const int*>(L.Perm), *const outer = lower.outerIndexPtr(),
                   *const inner = lower.innerIndexPtr();
  std::vector<int> place(L.n);
  for (int k = 0; k < n; ++k) place[order[k]] = k;
  Entries sorted{std::vector<int>(L.n + 1, 0), (n + n_parts - 1) / n_parts, {}};
  std::vector<int>& first = sorted.first;
  for (int c = 0; c < n; ++c)
    for (int slot = outer[c]; slot < outer[c + 1]; ++slot)
      ++first[std::min(place[c], place[inner[slot]]) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  for (int c = 0; c < n; c += sorted.part_size)
    sorted.parts.emplace_back(static_cast<std::size_t>(first[std::min(c + sorted.part_size, n)] - first[c]));
  std::vector<int> n_found(L.n, 0);
  for (int c = 0; c < n; ++c)
    for (int slot = outer[c]; slot < outer[c + 1]; ++slot) {
      const auto [column, row] = std::minmax({place[c], place[inner[slot]]});
      sorted.of_column(column)[static_cast<std::size_t>(n_found[column]++)] = {
          row, static_cast<float>(lower.valuePtr()[slot] * scale[c] * scale[inner[slot]])};
    }
  return sorted;
}

}  // namespace

std::optional<SinglePrecisionFactor> single_precision_factor(const cholmod_factor_struct& groups,
                                                             const FrontTree& tree,
                                                             const SparseMatrix& lower) {
  static const float least = std::sqrt(std::numeric_limits<float>::epsilon());
  std::optional<VectorXd> scale = scale_of(lower);
  if (!scale) return std::nullopt;
  SinglePrecisionFactor factor{std::move(*scale), LargeVector<float>(groups.xsize)};
  Entries K = in_order(groups, lower, factor.scale);
  LargeVector<float> waiting(static_cast<std::size_t>(tree.most_waiting()));
  float* const L = factor.entries.data();
  Fronts<float> fronts(tree, L, L, waiting, true);
  std::vector<int> place(groups.n);  // of a row in the front
  for (int s = 0; s < tree.n_groups(); ++s) {
    const std::span<const int> rows = tree.rows(s);
    for (std::size_t k = 0; k < rows.size(); ++k) place[rows[k]] = static_cast<int>(k);
    const DenseBlock<float> columns = fronts.columns(s, L);
    for (int c = 0; c < columns.n_columns; ++c)
      for (const Entry& entry : K.of_column(tree.first_column(s) + c))
        columns.column(c)[place[entry.row]] = entry.value;
    K.forget_before(tree.first_column(s));
    if (fronts.eliminate(s, least) < columns.n_columns) return std::nullopt;
  }
  return factor;
}

}  // namespace polyfem
