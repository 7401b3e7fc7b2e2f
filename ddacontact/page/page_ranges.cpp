#include <ddacontact/page/page_ranges.hpp>

#include <polyfem/material/linear_elastic.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

namespace {

constexpr double tail = 0.01;

double stress_value(Field field, const Vec3& stress) {
  if (field == Field::s1) return polyfem::principal_stresses(stress).s1;
  if (field == Field::s2) return polyfem::principal_stresses(stress).s2;
  return stress[field == Field::sxx ? 0 : field == Field::syy ? 1 : 2];
}

/// At the centre of every cell and halfway to its corners.
std::vector<Vec3> sampled_stresses(const PageFrame& shown) {
  const Frame& frame = shown.frame;
  std::vector<Vec3> stresses;
  for (int c = 0; c < frame.n_cells(); ++c) {
    const CellStressFit& fit = shown.stress[static_cast<std::size_t>(c)];
    stresses.push_back(fit.at_centre);
    const std::span<const int> points = frame.corners(c);
    Vec2 centre(0, 0);
    double size = 0;
    for (const int point : points) centre += frame.position.col(point) / static_cast<double>(points.size());
    for (const int point : points) size = std::max(size, (frame.position.col(point) - centre).norm());
    for (const int point : points) {
      const Vec2 arm = (frame.position.col(point) - centre) / (2 * size);
      stresses.emplace_back(fit.at_centre + arm.x() * fit.change_x + arm.y() * fit.change_y);
    }
  }
  return stresses;
}

std::vector<double> lengths(const Points& vectors, const Frame& frame) {
  std::vector<double> values;
  for (const int b : frame.present_blocks()) {
    const Range points = frame.points(b);
    for (int p = points.first; p < points.end(); ++p) values.push_back(vectors.col(p).norm());
  }
  return values;
}

}  // namespace

double percentile(std::vector<double> values, double fraction) {
  if (values.empty()) return 0;
  const double at = fraction * static_cast<double>(values.size() - 1);
  const auto low = values.begin() + static_cast<std::ptrdiff_t>(at);
  std::nth_element(values.begin(), low, values.end());
  const double below = *low;
  if (low + 1 == values.end()) return below;
  const double above = *std::min_element(low + 1, values.end());
  return below + (at - std::floor(at)) * (above - below);
}

void PageRanges::see(Field field, std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double cut = is_stress(field) ? tail : 0;
  const PageRange seen{{*low, *high}, {percentile(values, cut), percentile(values, 1 - cut)}};
  const auto [point, is_new] = of_fields_.try_emplace(field, seen);
  if (is_new) return;
  PageRange& range = point->second;
  range.all = {std::min(range.all.low, seen.all.low), std::max(range.all.high, seen.all.high)};
  range.robust = {std::min(range.robust.low, seen.robust.low), std::max(range.robust.high, seen.robust.high)};
}

void PageRanges::see(const PageFrame& shown, const PageArrays& arrays) {
  const Frame& frame = shown.frame;
  if (arrays.displacement) see(Field::displacement, lengths(frame.displacement, frame));
  if (arrays.velocity) see(Field::velocity, lengths(frame.velocity, frame));
  std::vector<double> forces;
  for (const FrameContact& contact : frame.contacts) forces.push_back(contact.force().norm());
  force_ = std::max(force_, percentile(std::move(forces), 1 - tail));
  if (!arrays.stress) return;
  const std::vector<Vec3> stresses = sampled_stresses(shown);
  for (const Field field : {Field::sxx, Field::syy, Field::sxy, Field::s1, Field::s2}) {
    std::vector<double> values;
    for (const Vec3& stress : stresses) values.push_back(stress_value(field, stress));
    see(field, std::move(values));
  }
}

}  // namespace ddacontact
