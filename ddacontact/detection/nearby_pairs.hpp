/// \file Which pairs of boxes touch while they move little.
#pragma once

#include <ddacontact/detection/broad_phase.hpp>

#include <vector>

namespace ddacontact {

/// Whether p lies in q.
bool lies_in(const Box& p, const Box& q);

/// The pairs that `overlapping_pairs` finds. They are looked for among wider boxes, and of these they are
/// taken until a box leaves its wider one.
class NearbyPairs {
 public:
  /// Writes `pairs`.
  /// \param[in] margins  by how much each box is widened when pairs are looked for; none: looks each time
  void find(const std::vector<Box>& boxes, const std::vector<double>& margins, std::vector<Pair>& pairs);
  /// How often pairs were looked for.
  long n_searches() const { return n_searches_; }

 private:
  std::vector<Box> wide_;  ///< boxes of which `candidates_` overlap
  std::vector<Pair> candidates_;
  long n_searches_ = 0;
};

}  // namespace ddacontact
