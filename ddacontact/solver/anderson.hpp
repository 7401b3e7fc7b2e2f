/// \file Anderson acceleration of a fixed-point iteration.
#pragma once

#include <ddacontact/core/types.hpp>

namespace ddacontact {

/// Given the step f(x) that the plain iteration x <- x + f(x) has taken, proposes the next x from the last
/// few: x + f - dY gamma with gamma the least-squares solution of dF gamma = f, where the columns of dY and
/// dF are differences of successive x + f and f. On a linear iteration it does what GMRES does: it converges
/// also where the plain iteration diverges.
class AndersonAcceleration {
 public:
  /// \param[in] depth  differences that are kept
  explicit AndersonAcceleration(Index depth = 8) : depth_(depth) {}

  void reset();
  /// \param[in] f      what the step has changed, of unknowns that tell how far the end is, comparable
  /// \param[in,out] x  after the step, and whatever else follows it linearly; becomes the next iterate
  /// \return the square of the length of f
  double advance(const VectorXd& f, VectorXd& x);

 private:
  Index depth_;
  Index n_ = 0;        ///< differences taken; the last few are kept, the oldest is replaced
  MatrixXd dy_, df_;   ///< a column each
  MatrixXd products_;  ///< of the columns of df_
  VectorXd last_y_, last_f_;
};

}  // namespace ddacontact
