#include <ddacontact/detection/nearby_pairs.hpp>

#include <algorithm>
#include <iterator>

namespace ddacontact {

bool lies_in(const Box& p, const Box& q) {
  return p.low.x() >= q.low.x() && p.low.y() >= q.low.y() && p.high.x() <= q.high.x() &&
         p.high.y() <= q.high.y();
}

void NearbyPairs::find(const std::vector<Box>& boxes, const std::vector<double>& margins,
                       std::vector<Pair>& pairs) {
  if (margins.empty() || !std::ranges::equal(boxes, wide_, lies_in)) {
    wide_ = boxes;
    for (std::size_t b = 0; b < margins.size(); ++b) wide_[b] = widened(boxes[b], margins[b]);
    candidates_ = overlapping_pairs(wide_);
    candidates_.shrink_to_fit();  // kept for long
    ++n_searches_;
  }
  pairs.clear();
  std::ranges::copy_if(candidates_, std::back_inserter(pairs),
                       [&](const Pair& pair) { return touch(boxes[pair[0]], boxes[pair[1]]); });
}

}  // namespace ddacontact
