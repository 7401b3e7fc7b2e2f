/// \file A region of rock and what cuts it into blocks.
#pragma once

#include <ddacontact/core/types.hpp>
#include <polyfem/mesh/sliver_cells.hpp>

#include <cstdint>
#include <vector>

namespace ddacontact {

/// Parallel joints, as a survey gives them. Lengths in m, angles in degrees; deviations are standard
/// deviations of normal distributions, drawn for each trace anew.
struct JointSet {
  int joint = -1;                             ///< number of the joint law; -1: that of the materials
  double angle = 0, angle_deviation = 0;      ///< of the traces, counter-clockwise from x
  double spacing = 1, spacing_deviation = 0;  ///< normal to them
  double trace = 1e9, trace_deviation = 0;    ///< length of a trace
  double gap = 0, gap_deviation = 0;  ///< between the traces of a line: rock bridges; 0: a persistent joint
  /// Of an undisturbed set: the middle of a trace. Those of the next line are shifted by half of trace + gap.
  Vec2 origin{0, 0};
  int region = -1;  ///< where; -1: everywhere
};

/// A single joint: a line through points.
struct JointTrace {
  int joint = -1;
  Points points;
};

/// Voronoi cells in a region.
struct VoronoiCells {
  int joint = -1;
  int region = -1;  ///< -1: the domain
  int cells = 100;
};

/// A part of the domain. Blocks with their centroid in it belong to it; of concave ones without theirs, a
/// point inside.
struct DomainRegion {
  Points polygon;
  bool cut = false;  ///< whether its outline is a joint
  int joint = -1;    ///< of the outline
};

/// What is to be taken out: its outline is a cut, and never merged away.
struct DomainOpening {
  Points outline;
  int joint = -1;
};

/// What is done with slivers.
enum class SliverPolicy { merge, keep, refuse };

/// A domain and everything that cuts it.
struct Domain {
  Points boundary;  ///< simple, in either orientation
  std::uint64_t seed = 1;
  SliverPolicy sliver_policy = SliverPolicy::merge;
  polyfem::SliverLimits sliver;
  /// Whether a vertex on an edge of a neighbour, where a joint ends, becomes a vertex of the neighbour.
  bool keep_t_vertices = false;
  double snap = 0;  ///< vertices nearer to each other become one, m; 0: 1e-6 of the size of a block
  std::vector<DomainRegion> regions;
  std::vector<DomainOpening> openings;
  std::vector<JointTrace> traces;
  std::vector<JointSet> joint_sets;
  std::vector<VoronoiCells> voronoi;
};

}  // namespace ddacontact
