/// \file The matrix of a block, of all its parts.
#pragma once

#include <ddacontact/block/block.hpp>

namespace support {

/// The derivative of the forces that resist d in a step of the block, n_unknowns x n_unknowns.
inline ddacontact::MatrixXd tangent_of(const ddacontact::Block& block, const ddacontact::BlockStep& step,
                                       const ddacontact::VectorXd& d) {
  std::vector<ddacontact::MatrixXd> parts(block.n_parts());
  step.tangent(d, parts);
  ddacontact::MatrixXd sum = ddacontact::MatrixXd::Zero(block.n_unknowns(), block.n_unknowns());
  for (int p = 0; p < block.n_parts(); ++p) {
    const std::vector<int> u = block.part_unknowns(p);
    sum(u, u) += parts[p];
  }
  return sum;
}

}  // namespace support
