/// \file A page of vector graphics (SVG 1.1) in the making.
#pragma once

#include <ddacontact/core/types.hpp>
#include <ddacontact/picture/colour.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace ddacontact {

/// Two decimals at most, no needless zeros. Numbers that are not finite or beyond 1e6 pixels become the
/// nearest that are not, so that a page is valid whatever is drawn.
std::string pixel_text(double pixels);

/// `&`, `<`, `>` and `"` written out; bytes that are no UTF-8 and control characters left out.
std::string escaped(std::string_view text);

/// A symbol with its index, and what follows: sigma, "xx", " (MPa)".
struct Label {
  std::string base, index, rest;
};

/// What a text will be about as wide as in Helvetica or Arial.
double text_width(std::string_view text, double font_size);
/// The same with a smaller index.
double text_width(const Label& label, double font_size);

/// Which part of a text stands at its place.
enum class Anchor { start, middle, end };

/// How a text looks; sizes in pixels.
struct TextStyle {
  double size = 12;
  Anchor anchor = Anchor::start;
  Colour colour{34, 34, 34};
  bool bold = false;
  bool halo = false;     ///< a white rim, to be legible on a picture
  bool upwards = false;  ///< turned a quarter left
};

/// Data of a path, relative and in hundredths of a pixel; errors do not add up.
class PathData {
 public:
  void move_to(const Vec2& point);
  void line_to(const Vec2& point);
  /// A closed polygon. Corners that fall together on the page are left out.
  void polygon(const std::vector<Vec2>& corners);

  const std::string& text() const { return text_; }
  bool empty() const { return text_.empty(); }

 private:
  void append(long hundredths);
  void step_to(const Vec2& point);

  std::string text_;
  long x_ = 0, y_ = 0;  ///< the pen, in hundredths
};

/// Elements are drawn in the order they are added. Coordinates are pixels, y downwards. `style` is a list of
/// SVG attributes.
class SvgPage {
 public:
  void path(const PathData& data, std::string_view style);
  void line(const Vec2& from, const Vec2& to, std::string_view style);
  void rectangle(const Vec2& corner, const Vec2& size, std::string_view style);
  void text(const Vec2& at, std::string_view text, const TextStyle& style = {});
  void text(const Vec2& at, const Label& label, const TextStyle& style = {});
  /// What is added until `end_group` is shown inside the rectangle alone.
  void begin_clipped(const Vec2& corner, const Vec2& size);
  void end_group() { body_ += "</g>\n"; }

  /// The whole file, on white.
  std::string finish(double width, double height) const;

 private:
  void open_text(const Vec2& at, const TextStyle& style);

  std::string body_;
  int n_clips_ = 0;
};

}  // namespace ddacontact
