/// \file Blocks that move, in groups of neighbours: what sweeps over blocks run through.
#pragma once

#include <ddacontact/solver/friction_problem.hpp>

#include <algorithm>
#include <span>
#include <vector>

namespace ddacontact {

/// The blocks of a FrictionProblem that have free unknowns, in groups of neighbours of at most `group_size`,
/// within each in the order of the matrices. The unknowns of a block follow one another in packed vectors.
/// None of it depends on the number of threads. Where groups meet, sweeps lose: groups are large.
class BlockGroups {
 public:
  static constexpr int largest_block = 16;  ///< unknowns
  static constexpr int group_size = 12000;  ///< blocks

  /// A contact of a block with another one, or with what is held.
  struct Neighbour {
    int contact;
    int block;      ///< its place in the order; -1: held
    int back;       ///< the index of the contact among the neighbours of all blocks seen from there, -1: held
    int n_entries;  ///< how many pairs of the block's unknowns, the first of each at an even place, it moves
                    ///< with
  };

  /// False: matrices of the problem share unknowns, are larger than `largest_block`, or of an odd
  /// number of unknowns.
  [[nodiscard]] bool set(FrictionProblem& problem, const std::vector<ContactTerm>& contacts);

  int n_blocks() const { return static_cast<int>(matrices_.size()); }
  int n_groups() const { return (n_blocks() + group_size - 1) / group_size; }
  Range group(int g) const { return {g * group_size, std::min(group_size, n_blocks() - g * group_size)}; }
  static int group_of(int block) { return block / group_size; }
  /// Places of a block's unknowns in packed vectors.
  Range unknowns(int block) const {
    return {first_[static_cast<std::size_t>(block)],
            first_[static_cast<std::size_t>(block) + 1] - first_[static_cast<std::size_t>(block)]};
  }
  int n_unknowns() const { return first_.back(); }
  /// A block's matrix, with those rows and columns of held unknowns that the identity has.
  void copy_matrix(FrictionProblem& problem, int block, Eigen::Map<MatrixXd>& to) const;
  /// Contacts of a block, ascending.
  std::span<const Neighbour> neighbours(int block) const {
    return std::span(neighbours_)
        .subspan(first_neighbour_[static_cast<std::size_t>(block)],
                 first_neighbour_[static_cast<std::size_t>(block) + 1] -
                     first_neighbour_[static_cast<std::size_t>(block)]);
  }
  /// The index of the first of them among those of all blocks.
  int first_neighbour(int block) const {
    return static_cast<int>(first_neighbour_[static_cast<std::size_t>(block)]);
  }
  const Neighbour& neighbour(int index) const { return neighbours_[static_cast<std::size_t>(index)]; }
  int n_neighbours() const { return static_cast<int>(neighbours_.size()); }
  /// The place of an unknown in packed vectors, -1: held.
  int place(int unknown) const { return place_[static_cast<std::size_t>(unknown)]; }

  /// packed = v; entries of held unknowns of moving blocks become 0.
  void pack(const VectorXd& v, VectorXd& packed) const;
  /// The same backwards, 0 elsewhere.
  void unpack(const VectorXd& packed, VectorXd& v) const;

 private:
  std::vector<int> matrices_, first_, place_;
  std::vector<int> unknown_;                  ///< at each place, -1: held
  std::vector<std::size_t> first_neighbour_;  ///< of each block, and their number
  std::vector<Neighbour> neighbours_;
};

}  // namespace ddacontact
