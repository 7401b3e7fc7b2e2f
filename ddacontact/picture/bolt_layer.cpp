#include <ddacontact/picture/bolt_layer.hpp>

#include <ddacontact/picture/number_text.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

namespace {

constexpr double thinnest = 1.2, thickest = 4;  // px
const Colour elastic{120, 30, 140}, at_bound{190, 30, 45}, torn{110, 110, 110};

bool is_at_bound(const BoltLine& bolt) {
  return bolt.state == "yield" || bolt.state == "buckled" || bolt.state == "slip";
}

}  // namespace

double largest_force(const std::vector<BoltLine>& bolts) {
  double largest = 0;
  for (const BoltLine& bolt : bolts) largest = std::max(largest, std::abs(bolt.axial_force));
  return largest;
}

void draw_bolts(SvgPage& page, const View& view, const std::vector<BoltLine>& bolts, double largest) {
  for (const BoltLine& bolt : bolts) {
    if (bolt.state == "absent") continue;
    const double part = largest > 0 ? std::abs(bolt.axial_force) / largest : 0;
    const Colour& colour = bolt.state == "torn" ? torn : is_at_bound(bolt) ? at_bound : elastic;
    page.line(view(bolt.from), view(bolt.to),
              "stroke=\"" + hex(colour) + "\" stroke-width=\"" +
                  number_text(thinnest + part * (thickest - thinnest), 3) + "\"" +
                  (bolt.state == "torn" ? " stroke-dasharray=\"3 2\"" : ""));
  }
}

std::vector<LegendItem> bolt_explanations(const std::vector<BoltLine>& bolts, double largest) {
  std::vector<LegendItem> items;
  const auto any = [&](const auto& is) { return std::ranges::any_of(bolts, is); };
  if (any([](const BoltLine& b) { return b.state == "elastic"; }))
    items.push_back(swatch(elastic, "bolt, at most " + quantity_text(largest, "N/m")));
  if (any(is_at_bound)) items.push_back(swatch(at_bound, "bolt that yields, buckles or slips"));
  if (any([](const BoltLine& b) { return b.state == "torn"; })) items.push_back(swatch(torn, "torn bolt"));
  return items;
}

}  // namespace ddacontact
