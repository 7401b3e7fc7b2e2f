/// \file Blocks of all sizes with random matrices and contacts, as parts of the solver see them.
#pragma once

#include <ddacontact/solver/friction_problem.hpp>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

namespace support {

using namespace ddacontact;

/// Block 0 is held, and some unknowns of others are. Unknowns of a block are scattered. Contacts join blocks
/// that are near each other in a random order.
struct RandomBlocks {
  std::mt19937 random;
  std::vector<std::vector<int>> unknowns;  ///< of each block
  std::vector<int> equation;
  std::vector<MatrixXd> matrices;
  std::vector<ContactTerm> contacts;
  std::vector<unsigned char> active;
  std::vector<Coupling> couplings;

  RandomBlocks(unsigned seed, int n_blocks, int n_contacts) : random(seed) {
    int n = 0;
    for (int b = 0; b < n_blocks; ++b) {
      constexpr int sizes[] = {2, 4, 6, 6, 8, 8, 10, 16};
      const int size = n_blocks > 1000 ? 2 : sizes[integer(0, 7)];
      unknowns.emplace_back(static_cast<std::size_t>(size));
      std::iota(unknowns.back().begin(), unknowns.back().end(), n);
      n += size;
      const MatrixXd a = MatrixXd::NullaryExpr(size, size, [&] { return uniform(-1, 1); });
      matrices.push_back(a * a.transpose() + 3 * MatrixXd::Identity(size, size));
    }
    const std::vector<int> scattered = shuffled(n);
    for (std::vector<int>& of_block : unknowns)
      for (int& u : of_block) u = scattered[static_cast<std::size_t>(u)];
    equation.assign(static_cast<std::size_t>(n), 0);
    for (int& e : equation) e = uniform(0, 1) < 0.1 ? -1 : 0;
    for (int u : unknowns[0]) equation[static_cast<std::size_t>(u)] = -1;
    int rows = 0;
    for (int& e : equation)
      if (e == 0) e = rows++;
    const std::vector<int> order = shuffled(n_blocks);
    for (int c = 0; c < n_contacts; ++c) {
      const int k = integer(0, n_blocks - 2), l = std::min(k + integer(1, 3), n_blocks - 1);
      add_contact(order[static_cast<std::size_t>(k)], order[static_cast<std::size_t>(l)]);
    }
  }

  double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random); }
  int integer(int low, int high) { return std::uniform_int_distribution(low, high)(random); }
  VectorXd vector(Index n) {
    return VectorXd::NullaryExpr(n, [&] { return uniform(-1, 1); });
  }
  Index n_unknowns() const { return static_cast<Index>(equation.size()); }
  bool is_prescribed(int u) const { return equation[static_cast<std::size_t>(u)] < 0; }

  FrictionProblem problem() const {
    FrictionProblem made(equation, *std::max_element(equation.begin(), equation.end()) + 1);
    polyfem::Connectivity rows;
    for (const std::vector<int>& of_block : unknowns) rows.append(of_block);
    made.set_matrices(rows);
    std::copy(matrices.begin(), matrices.end(), made.elements().begin());
    made.matrices_changed();
    return made;
  }

 private:
  std::vector<int> shuffled(int n) {
    std::vector<int> order(static_cast<std::size_t>(n));
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), random);
    return order;
  }

  /// Of up to three pairs of unknowns of each block.
  void add_contact(int a, int b) {
    ContactTerm& c = contacts.emplace_back();
    c.sheared = integer(0, 4) > 0;
    for (int block : {a, b}) {
      const std::vector<int>& of_block = unknowns[static_cast<std::size_t>(block)];
      for (int times = 0; times < 3; ++times) {
        const int first = 2 * integer(0, static_cast<int>(of_block.size()) / 2 - 1);
        for (int place : {first, first + 1}) {
          const int u = of_block[static_cast<std::size_t>(place)];
          c.gap.add(u, uniform(-1, 1));
          if (c.sheared) c.slip.add(u, uniform(-1, 1));
        }
      }
    }
    c.gap.constant = uniform(-1, 1);
    c.slip.constant = uniform(-1, 1);
    c.normal_stiffness = uniform(1, 10);
    c.tangential_stiffness = uniform(1, 10);
    active.push_back(static_cast<unsigned char>(c.sheared ? integer(0, 3) : integer(0, 1)));
    if (c.sheared && active.back() == 1)
      couplings.push_back({contacts.size() - 1, uniform(-0.5, 0.5) * c.normal_stiffness});
  }
};

}  // namespace support
