/// \file The water table of a picture.
#pragma once

#include <ddacontact/core/water.hpp>
#include <ddacontact/picture/legend.hpp>
#include <ddacontact/picture/svg.hpp>
#include <ddacontact/picture/view.hpp>

#include <vector>

namespace ddacontact {

/// The tables inside the view's box, level beyond their ends; that of joints dashed, where it is another.
void draw_water(SvgPage& page, const View& view, const Water& water);
/// The box with the tables that are above it: water that stands over blocks. A table below it acts on nothing
/// in it.
Window with_water(const Window& box, const Water& water);
/// What the lines mean that draw_water has drawn of any of these in boxes of their own.
/// \param[in] boxes  of each
std::vector<LegendItem> water_explanations(const std::vector<Water>& waters,
                                           const std::vector<Window>& boxes);

}  // namespace ddacontact
