/// \file Some blocks of a system as a system of their own.
#pragma once

#include <ddacontact/block/block_system.hpp>

#include <vector>

namespace ddacontact {

/// Some blocks of a system, lent to a system of their own that takes its place while steps are made: a step
/// costs what the part needs, whatever the size of the whole.
///
/// Blocks have the same order in both; only their numbers and ranges differ. Loads and supports of the part
/// are those of its blocks, and bolts those with all their nodes in it.
class BlockSystem::Part {
 public:
  /// \param[in] whole    lends its blocks for as long as this takes
  /// \param[in] blocks   ascending
  /// \param[in] resting  of each block of the whole: left where it is, as if wholly held, without its loads
  Part(BlockSystem& whole, std::vector<int> blocks, const std::vector<char>& resting);

  /// The part takes the place of the whole, with its present state. Costs what the part's size does.
  void put_in(BlockSystem& system, BlockState& state);
  /// The whole takes its place again, with what has become of the part.
  void take_out(BlockSystem& system, BlockState& state);

  /// The blocks of the part by their numbers in the whole.
  const std::vector<int>& blocks() const { return blocks_; }
  /// The number in the part of a block of the whole, -1: it is none of the part.
  int number_of(int block) const;
  bool is_resting(int k) const { return resting_[k]; }
  /// The numbers in the whole of the part's unknowns.
  const std::vector<int>& unknowns() const { return unknowns_; }
  /// And of its points.
  const std::vector<int>& points() const { return points_; }

 private:
  /// Numbers of a block in a system: its own, and the first ones of what belongs to it.
  struct Place {
    int block, point, unknown, stress_point, coordinate;
  };
  static void pass_blocks(BlockSystem& from, const std::vector<Place>& here, BlockSystem& to,
                          const std::vector<Place>& there);
  /// Calls move(entries of the whole, those of the part) for every array.
  template <class Move>
  void for_arrays(BlockState& whole, BlockState& part, const Move& move) const;
  void number_blocks(const BlockSystem& whole, const std::vector<char>& resting);
  void take_starts(const BlockSystem& whole);
  /// Loads, water, quiet faces and supports of the blocks that do not rest.
  void take_actions(const BlockSystem& whole);
  void take_bolts(const BlockSystem& whole);

  /// What the part has, by the numbers in the whole, ascending.
  std::vector<int> blocks_, points_, unknowns_, stress_points_, coordinates_, bolt_numbers_;
  std::vector<bool> resting_;
  std::vector<Place> in_whole_, in_part_;
  BlockSystem system_;  ///< the one of the two that is not in place
  BlockState state_;
};

}  // namespace ddacontact
