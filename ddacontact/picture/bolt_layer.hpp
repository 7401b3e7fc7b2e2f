/// \file Bolts of a picture.
#pragma once

#include <ddacontact/picture/legend.hpp>
#include <ddacontact/picture/svg.hpp>
#include <ddacontact/picture/view.hpp>

#include <string>
#include <vector>

namespace ddacontact {

/// A segment of a bolt, as bolts.csv has it.
struct BoltLine {
  Vec2 from{0, 0}, to{0, 0};  ///< m
  double axial_force = 0;     ///< N per m, tension positive
  std::string state;
};

/// Thicker the more they bear: 1 is `largest`, N per m.
void draw_bolts(SvgPage& page, const View& view, const std::vector<BoltLine>& bolts, double largest);
/// The largest magnitude of an axial force.
double largest_force(const std::vector<BoltLine>& bolts);
/// What the looks of these bolts mean.
std::vector<LegendItem> bolt_explanations(const std::vector<BoltLine>& bolts, double largest);

}  // namespace ddacontact
