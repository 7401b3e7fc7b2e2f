/// \file The matrix of a tangent, summed up term by term.
#pragma once

#include <tests/ddacontact/solver/random_blocks.hpp>

#include <Eigen/SparseCore>

namespace support {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// A + springs that act + couplings, rows and columns numbered by `row` (-1: none).
template <class Row>
SparseMatrix assembled_tangent(const RandomBlocks& blocks, Index n, const Row& row) {
  std::vector<Eigen::Triplet<double>> sum;
  const auto add = [&](int u, int v, double value) {
    if (row(u) >= 0 && row(v) >= 0) sum.emplace_back(row(u), row(v), value);
  };
  for (std::size_t e = 0; e < blocks.matrices.size(); ++e) {
    const std::vector<int>& unknowns = blocks.unknowns[e];
    for (std::size_t k = 0; k < unknowns.size(); ++k)
      for (std::size_t l = 0; l < unknowns.size(); ++l)
        add(unknowns[k], unknowns[l], blocks.matrices[e](static_cast<Index>(k), static_cast<Index>(l)));
  }
  const auto add_product = [&](double factor, const AffineForm& a, const AffineForm& b) {
    for (std::size_t k = 0; k < a.unknowns().size(); ++k)
      for (std::size_t l = 0; l < b.unknowns().size(); ++l)
        add(a.unknowns()[k], b.unknowns()[l], factor * a.coefficients()[k] * b.coefficients()[l]);
  };
  for (std::size_t c = 0; c < blocks.contacts.size(); ++c) {
    const ContactTerm& term = blocks.contacts[c];
    if (blocks.active[c] & 1) add_product(term.normal_stiffness, term.gap, term.gap);
    if (blocks.active[c] & 2) add_product(term.tangential_stiffness, term.slip, term.slip);
  }
  for (const Coupling& coupling : blocks.couplings)
    add_product(coupling.rate, blocks.contacts[coupling.contact].slip, blocks.contacts[coupling.contact].gap);
  SparseMatrix K(n, n);
  K.setFromTriplets(sum.begin(), sum.end());
  return K;
}

}  // namespace support
