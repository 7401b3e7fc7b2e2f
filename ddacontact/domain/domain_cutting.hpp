/// \file A domain cut into blocks by joints.
#pragma once

#include <ddacontact/domain/domain.hpp>

namespace ddacontact {

/// A block that joints cut out.
struct CutBlock {
  Points outline;                      ///< counter-clockwise, from its lowest vertex, the leftmost of several
  std::vector<int> joints;             ///< of each edge; -1: of none, or on the outline of the domain
  std::vector<int> regions, openings;  ///< that hold it
};

/// What was done on the way.
struct DomainCounts {
  int blocks = 0;
  int slivers_merged = 0, slivers_left = 0;
  int dangling_removed = 0;   ///< pieces of joints that divided nothing
  int connecting_joints = 0;  ///< joints added because a block surrounded others
  int t_vertices = 0;         ///< vertices on edges of neighbours that have no vertex there
  double area = 0;            ///< of all blocks, m2
};

/// The blocks of a domain.
struct CutDomain {
  std::vector<CutBlock> blocks;  ///< row by row from the bottom, in a row from the left, by their centroids
  DomainCounts counts;
};

/// No domain is cut into more.
inline constexpr double most_blocks = 1e6;

/// About how many blocks would come of it.
double expected_blocks(const Domain& domain);

/// Neighbours share their vertices to the bit, T-vertices apart, and the same domain gives the same bytes.
/// Joints end at the last joint that they cross. Throws Error, with the cure, for outlines that are not
/// simple, for more than `most_blocks` and for slivers where these are to be refused.
CutDomain cut_domain(const Domain& domain);

}  // namespace ddacontact
