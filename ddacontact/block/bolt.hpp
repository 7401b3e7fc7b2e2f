/// \file A bolt: an elastic-plastic bar between points of blocks.
#pragma once

#include <ddacontact/block/point_map.hpp>
#include <ddacontact/block/state.hpp>

#include <string>
#include <vector>

namespace ddacontact {

class BlockSystem;

/// A bar of segments between nodes, which are points of blocks. An anchored bar is fixed to its nodes. A
/// grouted one slips along itself at each node, against a bond that bears a force in proportion to the slip,
/// up to its strength. All forces are per metre of thickness, tension positive.
struct Bolt {
  static constexpr double infinity = inf;

  std::string name;
  std::vector<MaterialPoint> nodes;  ///< along the bar, two at least; block -1: gone with its block
  double stiffness = 0;              ///< E A, N per m
  double yield = infinity;           ///< of the axial force in tension and in compression, N per m
  double buckling = infinity;        ///< compression at which it gives way sideways, elastically, N per m
  double rupture_strain = infinity;  ///< of the steel, elastic and plastic
  double pretension = 0;             ///< axial force when it is installed, N per m
  /// The length of bar that each node of a grouted bar holds, m; empty: it is anchored.
  std::vector<double> bonded;
  double bond_stiffness = 0;        ///< force per length of bar and slip, N/m2 per m
  double bond_strength = infinity;  ///< force per length of bar, N/m per m
  bool installed = true;            ///< false: a later stage installs it
  Range numbers;                    ///< entries in BlockState::bolts

  int n_segments() const { return static_cast<int>(nodes.size()) - 1; }
  bool is_grouted() const { return !bonded.empty(); }
  /// Whether both ends of a segment are points of blocks that are there.
  bool has_segment(int k) const { return nodes[k].block >= 0 && nodes[k + 1].block >= 0; }

  // What BlockState::bolts has of it, by offset from `numbers.first` on, first of its segments, then, where
  // it is grouted, of its nodes.
  /// Numbers of a segment: its length when installed and its elongation without force, m; 1: it has torn.
  enum OfSegment { length_then, plastic_elongation, has_torn, per_segment };
  int n_numbers() const { return per_segment * n_segments() + (is_grouted() ? 2 * n_segments() + 2 : 0); }
  static int length(int segment) { return per_segment * segment + length_then; }
  static int plastic(int segment) { return per_segment * segment + plastic_elongation; }
  static int torn(int segment) { return per_segment * segment + has_torn; }
  /// Numbers of a node: the slip of the bar towards its last node, and the part of it without force, m.
  int slip(int node) const { return per_segment * n_segments() + 2 * node; }
  int plastic_slip(int node) const { return slip(node) + 1; }
};

/// Whether it is installed and a segment of it may move.
bool acts(const Bolt& bolt, const BlockSystem& blocks);
/// Vector from the first end of a segment to its second one, m.
Vec2 segment_vector(const Bolt& bolt, int segment, const BlockSystem& blocks, const BlockState& state);
/// Elongations of the rock between the nodes since the bolt was installed, m, one a segment.
VectorXd elongations(const Bolt& bolt, const BlockSystem& blocks, const BlockState& state);
/// Puts the bolt in where its nodes are: free of elongation, with its pretension.
void install(const Bolt& bolt, const BlockSystem& blocks, BlockState& state);

}  // namespace ddacontact
