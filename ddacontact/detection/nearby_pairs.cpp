#include <ddacontact/detection/nearby_pairs.hpp>

#include <ddacontact/core/bytes_of.hpp>

namespace ddacontact {

bool lies_in(const Box& p, const Box& q) {
  return p.low.x() >= q.low.x() && p.low.y() >= q.low.y() && p.high.x() <= q.high.x() &&
         p.high.y() <= q.high.y();
}

bool NearbyPairs::holds(const std::vector<Box>& boxes) const {
  if (boxes.size() != wide_.size()) return false;
  for (std::size_t b = 0; b < boxes.size(); ++b)
    if (!lies_in(boxes[b], wide_[b])) return false;
  return true;
}

void NearbyPairs::find(const std::vector<Box>& boxes, const std::vector<double>& margins,
                       std::vector<Pair>& pairs) {
  pairs.clear();
  if (margins.empty()) {
    wide_.clear();
    ++n_searches_;
    const std::vector<Pair>& found = broad_phase_.overlapping_pairs(boxes);
    pairs.assign(found.begin(), found.end());
    return;
  }
  if (!holds(boxes)) {
    wide_.resize(boxes.size());
    for (std::size_t b = 0; b < boxes.size(); ++b) {
      const Vec2 margin = Vec2::Constant(margins[b]);
      wide_[b] = {boxes[b].low - margin, boxes[b].high + margin};
    }
    candidates_ = broad_phase_.overlapping_pairs(wide_);
    broad_phase_ = {};
    ++n_searches_;
  }
  for (const Pair& pair : candidates_)
    if (touch(boxes[pair[0]], boxes[pair[1]])) pairs.push_back(pair);
}

double NearbyPairs::memory() const {
  return broad_phase_.memory() + bytes_of(wide_) + bytes_of(candidates_);
}

}  // namespace ddacontact
