#include <ddacontact/picture/colour.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ddacontact {

namespace {

using Channels = std::array<double, 3>;

/// Linear sRGB of an OKLab colour; outside [0, 1] when no screen shows it.
Channels linear_channels(double lightness, double chroma, double hue) {
  const double angle = hue * std::numbers::pi / 180;
  const double a = chroma * std::cos(angle), b = chroma * std::sin(angle);
  const auto cubed = [](double x) { return x * x * x; };
  const double l = cubed(lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cubed(lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cubed(lightness - 0.0894841775 * a - 1.2914855480 * b);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

bool shown(const Channels& channels) {
  return std::all_of(channels.begin(), channels.end(), [](double c) { return c > -1e-6 && c < 1 + 1e-6; });
}

int encoded(double linear) {
  const double c = std::clamp(linear, 0., 1.);
  const double gamma = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
  return static_cast<int>(std::lround(255 * gamma));
}

struct Tone {
  double lightness, chroma, hue;
};

Colour colour_of(const Tone& tone) {
  return perceptual_colour(tone.lightness, tone.chroma, tone.hue);
}

}  // namespace

std::string hex(const Colour& colour) {
  constexpr const char* digits = "0123456789abcdef";
  std::string text = "#";
  bool doubled = true;
  for (const int c : {colour.red, colour.green, colour.blue}) {
    text += {digits[c / 16], digits[c % 16]};
    doubled = doubled && c / 16 == c % 16;
  }
  return doubled ? std::string{'#', text[1], text[3], text[5]} : text;
}

Colour perceptual_colour(double lightness, double chroma, double hue) {
  double most = 0;
  if (shown(linear_channels(lightness, chroma, hue))) most = chroma;
  for (double step = chroma / 2; most < chroma && step > 1e-4; step /= 2)
    if (shown(linear_channels(lightness, most + step, hue))) most += step;
  const Channels c = linear_channels(lightness, most, hue);
  return {encoded(c[0]), encoded(c[1]), encoded(c[2])};
}

Colour sequential_colour(double t) {
  t = std::clamp(t, 0., 1.);
  return perceptual_colour(0.96 - 0.62 * t, 0.075 + 0.035 * t, 100 + 165 * t);
}

Colour diverging_colour(double t) {
  t = std::clamp(t, -1., 1.);
  const double size = std::abs(t);
  return perceptual_colour(
      0.97 - 0.55 * size, 0.17 * std::sin(std::numbers::pi / 2 * std::min(1., 1.4 * size)), t < 0 ? 255 : 32);
}

Colour kind_colour(int kind) {
  constexpr std::array<Tone, 8> tones = {{{0.88, 0.05, 85},
                                          {0.74, 0.09, 245},
                                          {0.80, 0.10, 150},
                                          {0.70, 0.12, 45},
                                          {0.91, 0.09, 105},
                                          {0.66, 0.09, 320},
                                          {0.86, 0.05, 220},
                                          {0.60, 0.04, 60}}};
  return colour_of(tones[static_cast<std::size_t>(kind) % tones.size()]);
}

Colour line_colour(int line) {
  constexpr std::array<Tone, 6> tones = {{{0.45, 0.14, 258},
                                          {0.64, 0.17, 45},
                                          {0.55, 0.12, 155},
                                          {0.42, 0.14, 350},
                                          {0.72, 0.11, 230},
                                          {0.30, 0.00, 0}}};
  return colour_of(tones[static_cast<std::size_t>(line) % tones.size()]);
}

}  // namespace ddacontact
