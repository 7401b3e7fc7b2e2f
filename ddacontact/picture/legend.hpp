/// \file Samples with their meaning, in lines below a picture.
#pragma once

#include <ddacontact/picture/arrows.hpp>

#include <functional>
#include <string>
#include <vector>

namespace ddacontact {

/// A sample and its text; `draw` gets the left end of the item, halfway up its line.
struct LegendItem {
  double width = 0;
  std::function<void(SvgPage&, const Vec2&)> draw;
};

/// px.
constexpr double legend_line_height = 22;

/// A round length of the scene, at most `most_pixels` long on the page.
LegendItem scale_bar(double pixels_per_metre, double most_pixels);

/// A square of a colour.
LegendItem swatch(const Colour& colour, const std::string& text);

/// A short line.
/// \param[in] style  SVG attributes
LegendItem line_sample(const std::string& style, const std::string& text);

/// An arrow of a round length.
/// \param[in] longest  the largest vector in the picture, > 0
LegendItem arrow_sample(VectorKind kind, Arrow::Look look, double longest, double pixels_per_unit,
                        const std::string& text);

/// How many lines the items take, none wider than `width` unless it is a single item.
int legend_lines(const std::vector<LegendItem>& items, double width);

/// Draws them below `corner`.
void draw_legend(SvgPage& page, const Vec2& corner, const std::vector<LegendItem>& items, double width);

}  // namespace ddacontact
