#include <ddacontact/picture/view.hpp>

#include <polyfem/geometry/area_moments.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

Window united(const Window& a, const Window& b) {
  return {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)};
}

Window bounding_box(const Frame& frame, bool reference) {
  if (frame.position.cols() == 0) return {};
  Window box{frame.position.rowwise().minCoeff(), frame.position.rowwise().maxCoeff()};
  if (reference && frame.displacement.cols() == frame.position.cols()) {
    const Points start = frame.position - frame.displacement;
    box = united(box, {start.rowwise().minCoeff(), start.rowwise().maxCoeff()});
  }
  return box;
}

Window padded(const Window& box, double margin) {
  const double larger = std::max(box.width(), box.height());
  const double least = 1e-12 * std::max(box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff());
  const double room = larger > 0 ? std::max(margin * larger, least) : 1;
  return {box.low.array() - room, box.high.array() + room};
}

double typical_size(const Frame& frame) {
  std::vector<double> sizes;
  for (int b : frame.present_blocks())
    sizes.push_back(std::sqrt(std::abs(polyfem::signed_area(frame.outline(b)))));
  if (sizes.empty()) return 0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

}  // namespace ddacontact
