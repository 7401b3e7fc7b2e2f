#include <ddacontact/picture/svg.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

namespace {

long hundredths(double pixels) {
  return std::isfinite(pixels) ? std::lround(100 * std::clamp(pixels, -1e6, 1e6)) : 0;
}

void append_hundredths(std::string& text, long value) {
  if (value < 0) {
    text += '-';
    value = -value;
  }
  const long whole = value / 100, part = value % 100;
  if (whole > 0 || part == 0) text += std::to_string(whole);
  if (part == 0) return;
  text += '.';
  text += static_cast<char>('0' + part / 10);
  if (part % 10 != 0) text += static_cast<char>('0' + part % 10);
}

std::string attribute(std::string_view name, double pixels) {
  return " " + std::string(name) + "=\"" + pixel_text(pixels) + "\"";
}

double character_width(unsigned char c) {
  if ((c & 0xc0) == 0x80) return 0;  // the rest of a character of several bytes
  if (std::string_view("ijl.,:;'|! ()[]ft/").find(static_cast<char>(c)) != std::string_view::npos)
    return 0.29;
  if (std::string_view("mwMW%@").find(static_cast<char>(c)) != std::string_view::npos) return 0.86;
  if (c >= 'A' && c <= 'Z') return 0.69;
  return 0.56;
}

/// How many bytes the UTF-8 character at `i` has; 0 when it is none.
std::size_t character_bytes(std::string_view text, std::size_t i) {
  const auto lead = static_cast<unsigned char>(text[i]);
  const std::size_t n = lead < 0x80                   ? 1
                        : lead >= 0xf0 && lead < 0xf5 ? 4
                        : lead >= 0xe0                ? 3
                        : lead >= 0xc2                ? 2
                                                      : 0;
  if (n == 0 || lead >= 0xf5 || i + n > text.size()) return 0;
  for (std::size_t k = 1; k < n; ++k)
    if ((static_cast<unsigned char>(text[i + k]) & 0xc0) != 0x80) return 0;
  return n;
}

constexpr double index_size = 0.72;

}  // namespace

std::string pixel_text(double pixels) {
  std::string text;
  append_hundredths(text, hundredths(pixels));
  return text;
}

std::string escaped(std::string_view text) {
  std::string safe;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t n = character_bytes(text, i);
    const std::string_view character = text.substr(i, std::max<std::size_t>(n, 1));
    i += character.size();
    if (character == "&")
      safe += "&amp;";
    else if (character == "<")
      safe += "&lt;";
    else if (character == ">")
      safe += "&gt;";
    else if (character == "\"")
      safe += "&quot;";
    else if (n > 0 && (static_cast<unsigned char>(character[0]) >= 0x20 || character == "\t"))
      safe += character;
  }
  return safe;
}

double text_width(std::string_view text, double font_size) {
  double width = 0;
  for (const char c : text) width += character_width(static_cast<unsigned char>(c));
  return width * font_size;
}

double text_width(const Label& label, double font_size) {
  return text_width(label.base, font_size) + text_width(label.index, index_size * font_size) +
         text_width(label.rest, font_size);
}

void PathData::append(long value) {
  if (value >= 0 && text_.back() != 'm') text_ += ' ';
  append_hundredths(text_, value);
}

void PathData::step_to(const Vec2& point) {
  const long x = hundredths(point.x()), y = hundredths(point.y());
  append(x - x_);
  append(y - y_);
  x_ = x;
  y_ = y;
}

void PathData::move_to(const Vec2& point) {
  text_ += 'm';  // the first one of a path counts as absolute
  step_to(point);
}

void PathData::line_to(const Vec2& point) {
  step_to(point);  // pairs after the first of "m" are lines
}

void PathData::polygon(const std::vector<Vec2>& corners) {
  if (corners.empty()) return;
  move_to(corners.front());
  const long start_x = x_, start_y = y_;
  for (std::size_t i = 1; i < corners.size(); ++i)
    if (hundredths(corners[i].x()) != x_ || hundredths(corners[i].y()) != y_) line_to(corners[i]);
  text_ += 'z';
  x_ = start_x;  // where closing leaves the pen
  y_ = start_y;
}

void SvgPage::path(const PathData& data, std::string_view style) {
  if (data.empty()) return;
  body_ += "<path ";
  body_ += style;
  body_ += " d=\"" + data.text() + "\"/>\n";
}

void SvgPage::line(const Vec2& from, const Vec2& to, std::string_view style) {
  PathData data;
  data.move_to(from);
  data.line_to(to);
  path(data, style);
}

void SvgPage::rectangle(const Vec2& corner, const Vec2& size, std::string_view style) {
  body_ += "<rect" + attribute("x", corner.x()) + attribute("y", corner.y()) + attribute("width", size.x()) +
           attribute("height", size.y()) + " ";
  body_ += style;
  body_ += "/>\n";
}

void SvgPage::open_text(const Vec2& at, const TextStyle& style) {
  body_ += "<text" + attribute("x", at.x()) + attribute("y", at.y()) + attribute("font-size", style.size);
  if (style.anchor != Anchor::start)
    body_ += style.anchor == Anchor::middle ? " text-anchor=\"middle\"" : " text-anchor=\"end\"";
  body_ += " fill=\"" + hex(style.colour) + "\"";
  if (style.bold) body_ += " font-weight=\"bold\"";
  if (style.halo)
    body_ += " stroke=\"#fff\" stroke-linejoin=\"round\" paint-order=\"stroke\"" +
             attribute("stroke-width", 0.2 * style.size);
  if (style.upwards)
    body_ += " transform=\"rotate(-90 " + pixel_text(at.x()) + " " + pixel_text(at.y()) + ")\"";
  body_ += ">";
}

void SvgPage::text(const Vec2& at, std::string_view text, const TextStyle& style) {
  open_text(at, style);
  body_ += escaped(text) + "</text>\n";
}

void SvgPage::text(const Vec2& at, const Label& label, const TextStyle& style) {
  open_text(at, style);
  body_ += escaped(label.base);
  if (!label.index.empty()) {
    const double drop = 0.22 * style.size;
    // A space at the start of a tspan is dropped by some programs, at its end by none.
    const bool spaced = label.rest.starts_with(' ');
    body_ += "<tspan" + attribute("dy", drop) + attribute("font-size", index_size * style.size) + ">" +
             escaped(label.index) + (spaced ? " </tspan>" : "</tspan>");
    body_ += "<tspan" + attribute("dy", -drop) + ">" + escaped(label.rest.substr(spaced ? 1 : 0)) +
             "</tspan></text>\n";
  } else {
    body_ += escaped(label.rest) + "</text>\n";
  }
}

void SvgPage::begin_clipped(const Vec2& corner, const Vec2& size) {
  const std::string name = "clip" + std::to_string(n_clips_++);
  body_ += "<clipPath id=\"" + name + "\">";
  rectangle(corner, size, "");
  body_ += "</clipPath>\n<g clip-path=\"url(#" + name + ")\">\n";
}

std::string SvgPage::finish(double width, double height) const {
  const std::string w = pixel_text(width), h = pixel_text(height);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w + "\" height=\"" + h + "\" viewBox=\"0 0 " +
         w + " " + h + "\" font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\">\n" +
         "<rect width=\"" + w + "\" height=\"" + h + "\" fill=\"#fff\"/>\n" + body_ + "</svg>\n";
}

}  // namespace ddacontact
