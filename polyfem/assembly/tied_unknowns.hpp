/// \file Unknowns that follow others by linear relations, taken out of a system: sliding on inclined edges,
/// ties, periodic cells.
#pragma once

#include <polyfem/assembly/prescribed_dofs.hpp>

#include <map>
#include <utility>
#include <vector>

namespace polyfem {

/// What a tied unknown follows.
struct TieTerm {
  int unknown;
  double factor;
};

/// u = T q + g: all unknowns by those that are neither tied nor held, q, in ascending order.
struct Reduction {
  SparseMatrix T;
  VectorXd g;
};

/// Relations u_k = constant + sum of factor_j u_j. What an unknown follows may be tied itself, not in a
/// circle.
class TiedUnknowns {
 public:
  /// One relation.
  struct Tie {
    std::vector<TieTerm> terms;
    double constant;
  };

  /// Once more to change the relation of an unknown.
  void tie(int unknown, std::vector<TieTerm> terms, double constant) {
    ties_[unknown] = {std::move(terms), constant};
  }
  void release_all() { ties_.clear(); }
  bool empty() const { return ties_.empty(); }
  bool is_tied(int unknown) const { return ties_.contains(unknown); }
  const std::map<int, Tie>& ties() const { return ties_; }

  /// Throws Error, with the unknown's number, where relations go in a circle.
  Reduction reduce(const PrescribedDofs& prescribed, int n_unknowns) const;

 private:
  std::map<int, Tie> ties_;
};

}  // namespace polyfem
