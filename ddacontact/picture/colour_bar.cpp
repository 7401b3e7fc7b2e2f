#include <ddacontact/picture/colour_bar.hpp>

#include <ddacontact/picture/number_text.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

namespace {

constexpr double least_bar_height = 110, bar_width = 13, title_height = 25, tip = 9, tick_length = 4,
                 tick_size = 11, title_size = 12.5, remark_size = 10, remark_height = 13;

/// Ticks in the prefixed unit.
struct Marks {
  Prefix prefix;
  Ticks ticks;
  std::vector<std::string> texts;
};

Marks marks_of(const ColourScale& scale, int most) {
  Marks marks;
  const double low = scale.bounds().front(), high = scale.bounds().back();
  marks.prefix = prefix_of(std::max(std::abs(low), std::abs(high)), description(scale.field()).unit);
  if (scale.is_constant()) {
    marks.ticks.values = {low / marks.prefix.factor};
    marks.texts = {number_text(low / marks.prefix.factor, 4)};
    return marks;
  }
  marks.ticks = ticks_between(low / marks.prefix.factor, high / marks.prefix.factor, most);
  for (const double value : marks.ticks.values) marks.texts.push_back(tick_text(value, marks.ticks.step));
  return marks;
}

int most_ticks(double bar_height) {
  return std::clamp(static_cast<int>(bar_height / 26), 2, 9);
}

Label title_of(const ColourScale& scale, const Prefix& prefix) {
  const FieldDescription& field = description(scale.field());
  Label title = field.symbol;
  title.rest += " (" + prefix.symbol + field.unit + ")";
  return title;
}

void draw_tick(SvgPage& page, const Vec2& at, const std::string& text) {
  page.line(at, at + Vec2(tick_length, 0), "stroke=\"#222\" stroke-width=\"0.7\"");
  page.text(at + Vec2(tick_length + 3, 0.35 * tick_size), text, {.size = tick_size});
}

void draw_constant(SvgPage& page, const Vec2& corner, const ColourScale& scale, const Marks& marks) {
  page.rectangle(corner, {bar_width, bar_width},
                 "fill=\"" + hex(scale.colour(0)) + "\" stroke=\"#222\" stroke-width=\"0.7\"");
  draw_tick(page, corner + Vec2(bar_width, bar_width / 2), marks.texts[0]);
  page.text(corner + Vec2(0, bar_width + 16), "everywhere", {.size = tick_size});
}

/// Below a bar that does not reach all values: how its ends were chosen, and the values.
std::vector<std::string> remarks_on(const ColourScale& scale, const Prefix& prefix) {
  std::vector<std::string> remarks;
  if (!scale.cut_below() && !scale.cut_above()) return remarks;
  if (!scale.note().empty()) remarks.push_back(scale.note());
  remarks.push_back("min " + number_text(scale.data().low / prefix.factor, 3));
  remarks.push_back("max " + number_text(scale.data().high / prefix.factor, 3));
  return remarks;
}

/// Each band reaches to the top and is covered by the next, so that no gap shows between them.
void draw_bands(SvgPage& page, const Vec2& top, double height, const ColourScale& scale) {
  const double low = scale.bounds().front(), high = scale.bounds().back();
  for (int k = 0; k < scale.n_bands(); ++k) {
    const double share = (high - scale.bounds()[static_cast<std::size_t>(k)]) / (high - low);
    page.rectangle(top, {bar_width, share * height}, "fill=\"" + hex(scale.colour(k)) + "\"");
  }
}

/// A tip says that there are values beyond the end.
void draw_rim(SvgPage& page, const Vec2& top, double height, const ColourScale& scale) {
  const Vec2 right(bar_width, 0), down(0, height), middle(bar_width / 2, 0);
  std::vector<Vec2> rim = {top};
  if (scale.cut_above()) rim.push_back(top + middle - Vec2(0, tip));
  rim.insert(rim.end(), {top + right, top + right + down});
  if (scale.cut_below()) rim.push_back(top + down + middle + Vec2(0, tip));
  rim.push_back(top + down);
  const auto draw_tip = [&](const Vec2& end, double height_of_tip, int band) {
    PathData data;
    data.polygon({end, end + middle + Vec2(0, height_of_tip), end + right});
    page.path(data, "fill=\"" + hex(scale.colour(band)) + "\"");
  };
  if (scale.cut_above()) draw_tip(top, -tip, scale.n_bands() - 1);
  if (scale.cut_below()) draw_tip(top + down, tip, 0);
  PathData data;
  data.polygon(rim);
  page.path(data, "fill=\"none\" stroke=\"#222\" stroke-width=\"0.7\"");
}

}  // namespace

double least_bar_height_of(const ColourScale& scale) {
  if (scale.is_constant()) return 60;
  const bool is_cut = scale.cut_below() || scale.cut_above();
  return least_bar_height + (is_cut ? 3 * remark_height : 0);
}

double colour_bar_width(const ColourScale& scale) {
  const Marks marks = marks_of(scale, most_ticks(most_bar_height));
  double width = 0;
  for (const std::string& text : marks.texts) width = std::max(width, text_width(text, tick_size));
  const double ticks = bar_width + tick_length + 3 + width;
  const double constant = scale.is_constant() ? text_width("everywhere", tick_size) : 0;
  double remarks = 0;
  for (const std::string& remark : remarks_on(scale, marks.prefix))
    remarks = std::max(remarks, text_width(remark, remark_size));
  return std::max({ticks, constant, remarks, text_width(title_of(scale, marks.prefix), title_size)});
}

void draw_colour_bar(SvgPage& page, const Vec2& corner, double height, const ColourScale& scale) {
  double bar_height = std::max(height, least_bar_height_of(scale)) - title_height - 6;
  Vec2 top = corner + Vec2(0, title_height);
  const Prefix prefix = marks_of(scale, most_ticks(bar_height)).prefix;
  const std::vector<std::string> remarks = remarks_on(scale, prefix);
  for (std::size_t k = 0; k < remarks.size(); ++k) {
    const double below = bar_height - remark_height * static_cast<double>(remarks.size() - 1 - k);
    page.text(top + Vec2(0, below), remarks[k], {.size = remark_size});
  }
  if (!remarks.empty()) bar_height -= remark_height * static_cast<double>(remarks.size()) + 6;
  const Marks marks = marks_of(scale, most_ticks(bar_height));
  page.text(corner + Vec2(0, title_size), title_of(scale, marks.prefix), {.size = title_size});
  if (scale.is_constant()) return draw_constant(page, top, scale, marks);
  if (scale.cut_above()) {
    top.y() += tip;
    bar_height -= tip;
  }
  if (scale.cut_below()) bar_height -= tip;
  draw_bands(page, top, bar_height, scale);
  draw_rim(page, top, bar_height, scale);
  const double low = scale.bounds().front() / marks.prefix.factor,
               high = scale.bounds().back() / marks.prefix.factor;
  for (std::size_t i = 0; i < marks.texts.size(); ++i) {
    const double y = (high - marks.ticks.values[i]) / (high - low) * bar_height;
    draw_tick(page, top + Vec2(bar_width, y), marks.texts[i]);
  }
}

}  // namespace ddacontact
