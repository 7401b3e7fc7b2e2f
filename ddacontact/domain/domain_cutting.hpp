/// \file A domain cut into blocks by joints.
#pragma once

#include <ddacontact/domain/domain.hpp>

#include <polyfem/core/error.hpp>

#include <vector>

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
  int cut_by_longer = 0;      ///< blocks more if every end of a trace were a twentieth of its line further
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

/// About what would come of a domain, told from spacings and areas alone.
struct ExpectedCut {
  double blocks = 1;
  double traces = 0;  ///< of all joint sets
  /// Pairs of blocks whose boxes along the axes overlap, neighbours apart: oblique slender blocks have as
  /// many as they are long times the traces per length across them.
  double box_pairs = 0;
  int densest_set = -1;  ///< that of the most traces; -1: there is none
};
/// Without cutting it.
ExpectedCut expected_cut(const Domain& domain);

/// There would be more blocks or traces than `most_blocks`.
class TooManyBlocks : public Error {
 public:
  using Error::Error;
};

/// Neighbours share their vertices to the bit, T-vertices apart, and the same domain gives the same bytes.
/// Joints end at the last joint that they cross. Throws Error, with the cure, for outlines that are not
/// simple, TooManyBlocks, and Error for slivers where these are to be refused.
CutDomain cut_domain(const Domain& domain);

}  // namespace ddacontact
