/// \file Work that a step leaves out where the scene does not need it.
#pragma once

namespace ddacontact {

/// Each can be switched off, to see that the answer is the same without: the same bytes for those that leave
/// out what has no effect, within the tolerance of the residual for those that solve in another way.
struct Skips {
  // the same bytes
  bool friction_rows = true;     ///< no tangential terms where there is neither friction nor a bond
  bool fixed_blocks = true;      ///< no matrices of blocks that are wholly held
  bool unchanged_factor = true;  ///< the factor is used again while the matrix is the same
  bool congruent = true;         ///< congruent blocks share their reference matrices
  bool output = true;            ///< stresses and pictures only where requested
  // within the tolerance
  bool cg = true;       ///< sweeps over the contacts, without a factor, where inertia dominates
  bool islands = true;  ///< blocks that do not touch are solved apart
  bool sleep = true;    ///< islands at rest are left alone until something reaches them
  bool skin = true;     ///< pairs of blocks are looked for again only after motion beyond a margin

  bool operator==(const Skips&) const = default;
};

}  // namespace ddacontact
