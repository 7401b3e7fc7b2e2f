/// \file Colours, and maps from numbers to colours.
#pragma once

#include <string>

namespace ddacontact {

/// An sRGB colour, components 0 .. 255.
struct Colour {
  int red = 0, green = 0, blue = 0;
  bool operator==(const Colour&) const = default;
};

/// "#rrggbb", or "#rgb" where that is the same.
std::string hex(const Colour& colour);

/// A colour by OKLab lightness (0 black .. 1 white), chroma and hue (degrees), after Ottosson (2020): equal
/// steps look equally large. A chroma no screen shows is reduced to the largest it does.
Colour perceptual_colour(double lightness, double chroma, double hue);

/// For magnitudes, t in [0, 1]: from pale yellow over green to deep blue; lightness falls linearly, so it
/// also reads in grey and whatever the reader's colour vision.
Colour sequential_colour(double t);

/// For signed numbers, t in [-1, 1]: deep blue, nearly white at 0, deep red; lightness falls linearly with
/// |t|.
Colour diverging_colour(double t);

/// Light colours for kinds of things, told apart by lightness as well as by hue; they repeat after eight.
Colour kind_colour(int kind);

/// Dark colours for lines on white, told apart by lightness as well as by hue; they repeat after six.
Colour line_colour(int line);

}  // namespace ddacontact
