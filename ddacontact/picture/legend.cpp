#include <ddacontact/picture/legend.hpp>

#include <ddacontact/picture/number_text.hpp>

namespace ddacontact {

namespace {

constexpr double text_size = 11.5, gap = 20, text_gap = 6;

LegendItem item(double sample_width, const std::string& text,
                std::function<void(SvgPage&, const Vec2&)> sample) {
  const double text_at = sample_width + text_gap;
  return {text_at + text_width(text, text_size),
          [=, draw_sample_of = std::move(sample)](SvgPage& page, const Vec2& left) {
            draw_sample_of(page, left);
            page.text(left + Vec2(text_at, 0.35 * text_size), text, {.size = text_size});
          }};
}

/// Calls `place(item, line, x)` for each item.
template <class Place>
int flow(const std::vector<LegendItem>& items, double width, Place&& point) {
  int line = 0;
  double x = 0;
  for (const LegendItem& item : items) {
    if (x > 0 && x + item.width > width) {
      ++line;
      x = 0;
    }
    point(item, line, x);
    x += item.width + gap;
  }
  return items.empty() ? 0 : line + 1;
}

}  // namespace

LegendItem scale_bar(double pixels_per_metre, double most_pixels) {
  const double length = round_below(most_pixels / pixels_per_metre), pixels = length * pixels_per_metre;
  // 0.5 m rather than 500 mm beside a picture of metres.
  const Prefix prefix = prefix_of(10 * length, "m");
  const std::string text = number_text(length / prefix.factor, 1) + " " + prefix.symbol + "m";
  return item(pixels, text, [pixels](SvgPage& page, const Vec2& left) {
    const Vec2 up(0, -3.5), right(pixels, 0);
    PathData data;
    data.move_to(left + up);
    data.line_to(left - up);
    data.move_to(left);
    data.line_to(left + right);
    data.move_to(left + right + up);
    data.line_to(left + right - up);
    page.path(data, "fill=\"none\" stroke=\"#222\" stroke-width=\"1.2\"");
  });
}

LegendItem swatch(const Colour& colour, const std::string& text) {
  return item(12, text, [colour](SvgPage& page, const Vec2& left) {
    page.rectangle(left - Vec2(0, 6), {12, 12},
                   "fill=\"" + hex(colour) + "\" stroke=\"#222\" stroke-width=\"0.6\"");
  });
}

LegendItem line_sample(const std::string& style, const std::string& text) {
  constexpr double length = 26;
  return item(length, text,
              [=](SvgPage& page, const Vec2& left) { page.line(left, left + Vec2(length, 0), style); });
}

LegendItem arrow_sample(VectorKind kind, Arrow::Look look, double longest, double pixels_per_unit,
                        const std::string& text) {
  const double value = round_below(longest), pixels = value * pixels_per_unit;
  return item(pixels, quantity_text(value, unit_of(kind)) + " " + text,
              [=](SvgPage& page, const Vec2& left) { draw_sample(page, left, pixels, kind, look); });
}

int legend_lines(const std::vector<LegendItem>& items, double width) {
  return flow(items, width, [](const LegendItem&, int, double) {});
}

void draw_legend(SvgPage& page, const Vec2& corner, const std::vector<LegendItem>& items, double width) {
  flow(items, width, [&](const LegendItem& item, int line, double x) {
    item.draw(page, corner + Vec2(x, (line + 0.5) * legend_line_height));
  });
}

}  // namespace ddacontact
