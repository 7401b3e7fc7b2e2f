/// \file Some blocks of a system as a system of their own.
#pragma once

#include <ddacontact/block/block_system.hpp>

#include <vector>

namespace ddacontact {

/// Some blocks of a system, by their numbers, as a system of their own in which steps are made: a step costs
/// what the part needs, whatever the size of the whole.
///
/// Blocks have the same order in both; only their numbers and ranges differ. Loads and supports of the part
/// are those of its blocks, and bolts those with all their nodes in it.
class BlockSystem::Part {
 public:
  /// \param[in] blocks   ascending
  /// \param[in] resting  of each block of the whole: left where it is, as if wholly held, without its loads
  Part(const BlockSystem& whole, std::vector<int> blocks, const std::vector<char>& resting);

  BlockSystem& system() { return system_; }
  const BlockSystem& system() const { return system_; }
  BlockState& state() { return state_; }
  const BlockState& state() const { return state_; }
  /// Takes over a state of the whole, and the shapes that its blocks have.
  void read(const BlockSystem& whole, const BlockState& state);
  /// Writes what has become of the part into the whole.
  void write(BlockSystem& whole, BlockState& state) const;

  /// The blocks of the part by their numbers in the whole.
  const std::vector<int>& blocks() const { return blocks_; }
  /// The number in the part of a block of the whole, -1: it is none of the part.
  int number_of(int block) const;
  bool is_resting(int k) const { return system_.resting_[k]; }
  /// The numbers in the whole of the part's unknowns.
  const std::vector<int>& unknowns() const { return unknowns_; }
  /// And of its points.
  const std::vector<int>& points() const { return points_; }

 private:
  /// Calls move(entries of the whole, those of the part) for every array.
  template <class Whole, class Own, class Move>
  void for_arrays(Whole& whole, Own& part, const Move& move) const;
  static void pass_shape(const BlockSystem& from, int b, BlockSystem& to, int k);
  void take_starts(const BlockSystem& whole);
  /// Loads, water, quiet faces and supports of the blocks that do not rest.
  void take_actions(const BlockSystem& whole);
  void take_bolts(const BlockSystem& whole);

  /// What the part has, by the numbers in the whole, ascending.
  std::vector<int> blocks_, points_, unknowns_, stress_points_, coordinates_, bolt_numbers_;
  BlockSystem system_;
  BlockState state_;
};

}  // namespace ddacontact
