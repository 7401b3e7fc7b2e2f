/// \file The key to a field's colours, upright, beside a picture.
#pragma once

#include <ddacontact/picture/colour_scale.hpp>

namespace ddacontact {

/// Pixels from the left end of the bar or its title to the right end of its texts.
double colour_bar_width(const ColourScale& scale);

/// Title, bar and ticks within `height` pixels below `corner`; at least `least_bar_height_of`.
void draw_colour_bar(SvgPage& page, const Vec2& corner, double height, const ColourScale& scale);

/// What looks well; a constant needs little room.
double least_bar_height_of(const ColourScale& scale);
/// Beside tall pictures, px.
constexpr double most_bar_height = 300;

}  // namespace ddacontact
