/// \file Factors L L^T, and L U of matrices whose pattern is symmetric, made by fronts: what the elimination
/// of a group of columns subtracts from the rows below it waits for the group above (I. S. Duff and J. K. Reid,
/// "The multifrontal solution of indefinite sparse symmetric linear equations", 1983).
#pragma once

#include <polyfem/assembly/front_tree.hpp>
#include <polyfem/core/large_vector.hpp>

#include <cstddef>
#include <vector>

namespace polyfem {

/// The elimination of one group after another: K = L L^T, or K = L U without exchanging rows, with ones on the
/// diagonal of U.
///
/// Of the columns of a group the entries of L below the diagonal count, and those of U^T; on the diagonal is
/// one over the entry.
template <class Real>
class Fronts {
 public:
  /// \param[in,out] L, Ut    entries of both: those of a group are those of K and of K^T until it is eliminated.
  ///   Ut = L: K is symmetric
  /// \param[out] waiting  memory for what waits: as many numbers as `most_waiting` says
  /// \param[in] by_blas      larger groups are eliminated by BLAS
  Fronts(const FrontTree& tree, Real* L, Real* Ut, LargeVector<Real>& waiting, bool by_blas);

  /// Eliminates a group, all below it before. Returns how many of its columns had a pivot that serves: all, or
  /// it has failed. A pivot of a symmetric K has to be above `least`, another one may be any but 0.
  int eliminate(int s, Real least);

 private:
  bool is_symmetric() const { return L_ == Ut_; }
  std::ptrdiff_t square(int s) const {
    return static_cast<std::ptrdiff_t>(tree_.n_below(s)) * tree_.n_below(s);
  }
  void take_from(int child, const Real* from, const DenseBlock<Real>& L, const DenseBlock<Real>& Ut,
                 const DenseBlock<Real>& below) const;

  const FrontTree& tree_;
  Real *L_, *Ut_;
  LargeVector<Real>& waiting_;  ///< a stack of squares; of symmetric ones the lower triangles count
  bool by_blas_;
  std::vector<int> groups_;  ///< on the stack
  std::ptrdiff_t top_ = 0;
};

}  // namespace polyfem
