/// \file A bolt through one step: forces on the unknowns of its blocks, and their derivative.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/equations/bolt_law.hpp>

#include <vector>

namespace ddacontact {

/// An element of (13) over the unknowns that move its nodes. Its axial forces are those of the end of the
/// step along the segments there or, with half steps, at the start; or the means of both ends, along the mean
/// of the two, whose work over the step is what the bolt stores.
class StepBolt {
 public:
  /// \param[in] bolt  acts in the step
  StepBolt(const BlockSystem& blocks, const Bolt& bolt);

  const Bolt& bolt() const { return *bolt_; }
  /// Unknowns that its matrix is over, ascending.
  const std::vector<int>& unknowns() const { return unknowns_; }
  /// Blocks of its nodes, each once.
  const std::vector<int>& blocks() const { return blocks_; }

  void begin(const BlockSystem& blocks, const BlockState& state, Directions directions);
  /// Adds the stiffness T / l, N/m per m, by which its tension at the start turns segments between two blocks
  /// back, to the entries of both blocks.
  void add_turning(VectorXd& of_blocks) const;
  /// Sets the segments that its forces act along, from `begin` on.
  void act_along(Directions directions) { directions_ = directions; }
  /// Finds its forces where its unknowns are displaced so, by all unknowns.
  void evaluate(const VectorXd& displaced);
  /// Force of the bolt on a node where it was evaluated last, N per m.
  Vec2 force_on(int node) const;
  /// F += its forces on all unknowns.
  void add_forces(VectorXd& F) const;
  /// Minus their derivative over `unknowns`, as far as it has no eigenvalue below 0: segments in compression
  /// do not turn away from it.
  MatrixXd tangent() const;
  /// Force by elongation of its stiffest segment, N/m per m.
  double largest_stiffness() const;
  /// Ends the step: its entries in the numbers of all bolts follow where it was evaluated last.
  BoltLosses end(VectorXd& numbers) const;

 private:
  struct Term {
    int unknown, slot;  ///< its number, and its index in unknowns_
    Vec2 column;
  };
  struct Segment {
    bool is_there = false;
    Vec2 start{0, 0};      ///< from its first end to its second one
    Vec2 direction{0, 0};  ///< of its force; with means not of unit length
    double length = 0;     ///< where it was evaluated, m
    double turning = 0;    ///< force by displacement across it, N/m per m
  };
  Vec2 displacement(int node, const VectorXd& displaced) const;

  const Bolt* bolt_;
  std::vector<int> unknowns_, blocks_;
  std::vector<std::vector<Term>> maps_;  ///< of each node
  std::vector<Segment> segments_;
  Directions directions_ = Directions::of_end;
  VectorXd numbers_, elongation_;
  BoltForces start_, forces_;
  VectorXd axial_;  ///< axial forces that act in the step, N per m
};

}  // namespace ddacontact
