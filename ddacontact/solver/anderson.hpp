/// \file Anderson acceleration of a fixed-point iteration.
#pragma once

#include <ddacontact/core/types.hpp>

#include <vector>

namespace ddacontact {

/// Given x and the step f(x) that the plain iteration x <- x + f(x) would take, proposes the next x from the
/// last few: x + f - (dX + dF) gamma with gamma the least-squares solution of dF gamma = f, where the columns
/// of dX and dF are differences of successive x and f. On a linear iteration it does what GMRES does: it
/// converges also where the plain iteration diverges.
class AndersonAcceleration {
 public:
  /// \param[in] depth  differences that are kept
  explicit AndersonAcceleration(std::size_t depth = 8) : depth_(depth) {}

  void reset();
  /// \param[in,out] x  becomes the next iterate
  /// \param[in] weights  make the entries of f comparable
  void advance(const VectorXd& f, const VectorXd& weights, VectorXd& x);

 private:
  std::size_t depth_;
  std::vector<VectorXd> dx_, df_;  ///< the oldest first
  VectorXd last_x_, last_f_;
};

}  // namespace ddacontact
