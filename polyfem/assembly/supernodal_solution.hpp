/// \file Solutions with factors whose columns are stored in dense groups.
#pragma once

#include <polyfem/assembly/front_tree.hpp>
#include <polyfem/core/large_vector.hpp>
#include <polyfem/core/types.hpp>

#include <vector>

namespace polyfem {

/// x = (L U)^-1 b.
///
/// Threads share a large factor by parts of its elimination tree that are connected with the rest by the
/// groups above them alone. The parts follow from L: x has the same bytes with any number of threads.
class SupernodalSolution {
 public:
  /// What follows from where L has entries.
  void analyze(const FrontTree& tree);

  /// \param[in] tree          the one analyzed
  /// \param[in] lower, upper  entries of L and U^T, see Fronts; the same ones where U = L^T
  void solve(const FrontTree& tree, const LargeVector<double>& lower, const LargeVector<double>& upper,
             const VectorXd& b, VectorXd& x);
  /// x = (L L^T)^-1 b in single precision.
  void solve(const FrontTree& tree, const LargeVector<float>& lower, const VectorXd& b, VectorXd& x);

  /// Bytes that it holds.
  double memory() const;

 private:
  /// Groups `first` .. `end` - 1: all that is below some of them, which are neighbours.
  struct Part {
    int first, end;
    Index first_sum, n_sums;  ///< what it adds to rows of other groups is summed apart
    Index scratch;            ///< where its groups work
  };

  template <class Real>
  void solve(const FrontTree& tree, const Real* lower, const Real* upper, const VectorXd& b,
             Eigen::Matrix<Real, Eigen::Dynamic, 1>& work, VectorXd& x) const;
  void add_part(const FrontTree& tree, int first, int end);

  std::vector<Part> parts_;
  std::vector<int> above_;   ///< groups of no part, ascending
  std::vector<int> target_;  ///< where a group adds to each of its rows: the row, or a sum of its part
  std::vector<int> row_of_sum_;
  Index scratch_ = 0;  ///< where groups above the parts work
  Index n_work_ = 0;
  VectorXd work_;
  Eigen::VectorXf rough_work_;
};

}  // namespace polyfem
