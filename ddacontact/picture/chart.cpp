#include <ddacontact/picture/chart.hpp>

#include <ddacontact/picture/number_text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ddacontact {

namespace {

constexpr double margin = 12, tick_size = 11, label_size = 12, title_size = 14.5, title_line = 26;
constexpr double tick_length = 4, below_axis = 40, between = 14, key_line = 17, sample = 24;

/// Names in the key have room in fonts that stand in for the one that is requested.
constexpr double wider = 1.15;

/// One direction: values, their pixels and their ticks.
struct Axis {
  bool logarithmic = false;
  double low = 0, high = 1;  ///< what the ends stand for; logarithms on a logarithmic axis
  Prefix prefix;
  Ticks ticks;  ///< in the prefixed unit

  /// Not finite for what a logarithmic axis cannot show.
  double coordinate(double value) const { return logarithmic ? std::log10(value) : value; }
  double share(double value) const { return (coordinate(value) - low) / (high - low); }
  double tick_share(std::size_t tick) const { return share(ticks.values[tick] * prefix.factor); }
  std::string text(std::size_t tick) const {
    return logarithmic ? decade_text(ticks.values[tick]) : tick_text(ticks.values[tick], ticks.step);
  }
};

/// Widens a range that is nearly a single number.
void spread(Axis& axis) {
  const double size = std::max(std::abs(axis.low), std::abs(axis.high));
  if (axis.high - axis.low > 1e-9 * size && size > 0) return;
  const double half = axis.logarithmic || size == 0 ? 1 : 0.5 * size;
  axis.low -= half;
  axis.high += half;
}

/// \param[in] room  how much of the range is left free at both ends
Axis axis_of(const std::vector<Series>& series, std::vector<double> Series::*values, const std::string& unit,
             bool logarithmic, double room, int most_ticks) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Axis axis{logarithmic, infinity, -infinity, {}, {}};
  for (const Series& line : series)
    for (const double value : line.*values) {
      const double coordinate = axis.coordinate(value);
      if (!std::isfinite(coordinate)) continue;
      axis.low = std::min(axis.low, coordinate);
      axis.high = std::max(axis.high, coordinate);
    }
  if (axis.low > axis.high) axis.low = axis.high = 0;
  const double size = std::max(std::abs(axis.low), std::abs(axis.high));
  spread(axis);
  const double free = room * (axis.high - axis.low);
  axis.low -= free;
  axis.high += free;
  if (logarithmic) {
    axis.ticks.values = logarithmic_ticks(std::pow(10, axis.low), std::pow(10, axis.high), most_ticks);
    return axis;
  }
  axis.prefix = prefix_of(size, unit);
  axis.ticks = ticks_between(axis.low / axis.prefix.factor, axis.high / axis.prefix.factor, most_ticks);
  return axis;
}

Label titled(const Label& symbol, const Axis& axis, const std::string& unit) {
  Label label = symbol;
  if (!unit.empty()) label.rest += " (" + axis.prefix.symbol + unit + ")";
  return label;
}

std::string line_style(std::size_t line) {
  constexpr std::array<const char*, 3> dashes = {"", " stroke-dasharray=\"6 3\"",
                                                 " stroke-dasharray=\"2 2.5\""};
  return "fill=\"none\" stroke-width=\"1.5\" stroke-linejoin=\"round\" stroke=\"" +
         hex(line_colour(static_cast<int>(line))) + "\"" + dashes[line / 6 % dashes.size()];
}

constexpr const char* guide_style =
    "fill=\"none\" stroke-width=\"1\" stroke=\"#888\" stroke-dasharray=\"1.5 2.5\"";

std::string marker_style(std::size_t marker) {
  return "fill=\"#fff\" stroke-width=\"1.2\" stroke=\"" + hex(line_colour(static_cast<int>(marker))) + "\"";
}

void add_marker(PathData& data, const Vec2& at) {
  constexpr double half = 3.5;
  data.move_to(at - Vec2(half, 0));
  for (const Vec2& corner : {Vec2(0, -half), Vec2(half, 0), Vec2(0, half), Vec2(-half, 0)})
    data.line_to(at + corner);
}

void add_dot(PathData& data, const Vec2& at) {
  constexpr double half = 2;
  data.polygon(
      {at + Vec2(-half, -half), at + Vec2(half, -half), at + Vec2(half, half), at + Vec2(-half, half)});
}

std::string dot_style(std::size_t line) {
  return "fill=\"" + hex(line_colour(static_cast<int>(line))) + "\"";
}

class ChartPage {
 public:
  ChartPage(const std::vector<Chart>& charts, const ChartOptions& options)
      : charts_(charts), options_(options) {
    if (charts.empty()) throw Error("a picture of curves needs a chart");
    for (const Chart& chart : charts) {
      x_axes_.push_back(axis_of(chart.series, &Series::x, chart.x_unit, chart.x_logarithmic,
                                chart.x_logarithmic ? 0.04 : 0, 8));
      y_axes_.push_back(axis_of(chart.series, &Series::y, chart.y_unit, chart.y_logarithmic, 0.04, 6));
      for (std::size_t i = 0; i < y_axes_.back().ticks.values.size(); ++i)
        widest_tick_ = std::max(widest_tick_, text_width(y_axes_.back().text(i), tick_size));
      for (const Series& line : chart.series)
        if (chart.series.size() > 1)
          widest_name_ = std::max(widest_name_, wider * text_width(line.name, tick_size));
    }
    left_ = margin + label_size + 8 + widest_tick_ + tick_length + 4;
    const double key = widest_name_ > 0 ? sample + 10 + widest_name_ + 6 : 14;
    width_ = std::max(options.width - left_ - key - margin, 160.);
    page_width_ = left_ + width_ + key + margin;
  }

  std::string svg() {
    double y = margin;
    if (!options_.title.empty()) {
      page_.text({margin, margin + title_size}, options_.title, {.size = title_size, .bold = true});
      y += title_line;
    }
    for (std::size_t i = 0; i < charts_.size(); ++i) {
      corner_ = {left_, y + 6};
      draw_axes(i);
      draw_lines(i);
      draw_key(charts_[i]);
      const double key =
          charts_[i].series.size() > 1 ? static_cast<double>(charts_[i].series.size()) * key_line : 0;
      y += std::max(options_.plot_height + below_axis, key) + 6 + (i + 1 < charts_.size() ? between : 0);
    }
    return page_.finish(page_width_, y + 4);
  }

 private:
  void draw_axes(std::size_t i) {
    const Axis &x = x_axes_[i], &y = y_axes_[i];
    const Vec2 low = corner_ + Vec2(0, options_.plot_height);
    PathData grid, marks;
    for (std::size_t k = 0; k < x.ticks.values.size(); ++k) {
      const Vec2 at = low + Vec2(x.tick_share(k) * width_, 0);
      grid.move_to(at);
      grid.line_to(at - Vec2(0, options_.plot_height));
      marks.move_to(at);
      marks.line_to(at + Vec2(0, tick_length));
      page_.text(at + Vec2(0, tick_length + tick_size + 1), x.text(k),
                 {.size = tick_size, .anchor = Anchor::middle});
    }
    for (std::size_t k = 0; k < y.ticks.values.size(); ++k) {
      const Vec2 at = low - Vec2(0, y.tick_share(k) * options_.plot_height);
      grid.move_to(at);
      grid.line_to(at + Vec2(width_, 0));
      marks.move_to(at);
      marks.line_to(at - Vec2(tick_length, 0));
      page_.text(at + Vec2(-tick_length - 3, 0.35 * tick_size), y.text(k),
                 {.size = tick_size, .anchor = Anchor::end});
    }
    page_.path(grid, "fill=\"none\" stroke=\"#e4e4e4\" stroke-width=\"0.7\"");
    page_.path(marks, "fill=\"none\" stroke=\"#222\" stroke-width=\"0.8\"");
    page_.rectangle(corner_, {width_, options_.plot_height},
                    "fill=\"none\" stroke=\"#222\" stroke-width=\"0.8\"");
    page_.text(low + Vec2(width_ / 2, below_axis - 6), titled(charts_[i].x_symbol, x, charts_[i].x_unit),
               {.size = label_size, .anchor = Anchor::middle});
    page_.text({margin + label_size - 2, corner_.y() + options_.plot_height / 2},
               titled(charts_[i].y_symbol, y, charts_[i].y_unit),
               {.size = label_size, .anchor = Anchor::middle, .upwards = true});
  }

  void draw_lines(std::size_t i) {
    const Axis &x = x_axes_[i], &y = y_axes_[i];
    page_.begin_clipped(corner_ - Vec2(4, 4), {width_ + 8, options_.plot_height + 8});
    std::size_t n_lines = 0, n_marked = 0;
    for (const Series& series : charts_[i].series) {
      PathData data, dots;
      bool drawing = false;
      for (std::size_t k = 0; k < std::min(series.x.size(), series.y.size()); ++k) {
        const double x_share = x.share(series.x[k]), y_share = y.share(series.y[k]);
        const bool finite = std::isfinite(x_share) && std::isfinite(y_share);
        const Vec2 at = corner_ + Vec2(x_share * width_, (1 - y_share) * options_.plot_height);
        if (finite && series.markers) add_marker(data, at);
        if (finite && !series.markers && drawing) data.line_to(at);
        if (finite && !series.markers && !drawing) data.move_to(at);
        if (finite && series.dots) add_dot(dots, at);
        drawing = finite;
      }
      page_.path(dots, dot_style(n_lines));
      page_.path(data, style_of(series, n_lines, n_marked));
    }
    page_.end_group();
  }

  /// Counts the series of its kind.
  static std::string style_of(const Series& series, std::size_t& n_lines, std::size_t& n_marked) {
    if (series.guide) return guide_style;
    return series.markers ? marker_style(n_marked++) : line_style(n_lines++);
  }

  void draw_key(const Chart& chart) {
    if (chart.series.size() < 2) return;
    std::size_t n_lines = 0, n_marked = 0;
    Vec2 at = corner_ + Vec2(width_ + 10, 0.5 * key_line);
    for (const Series& series : chart.series) {
      const Vec2 middle = at + Vec2(sample / 2, 0);
      PathData dot, mark;
      if (series.dots) add_dot(dot, middle);
      if (series.markers) {
        add_marker(mark, middle);
      } else {
        mark.move_to(at);
        mark.line_to(at + Vec2(sample, 0));
      }
      page_.path(dot, dot_style(n_lines));
      page_.path(mark, style_of(series, n_lines, n_marked));
      page_.text(at + Vec2(sample + 6, 0.35 * tick_size), series.name, {.size = tick_size});
      at.y() += key_line;
    }
  }

  const std::vector<Chart>& charts_;
  const ChartOptions& options_;
  std::vector<Axis> x_axes_, y_axes_;
  double widest_tick_ = 0, widest_name_ = 0;
  double left_ = 0, width_ = 0, page_width_ = 0;
  Vec2 corner_{0, 0};  ///< upper left, of the chart being drawn
  SvgPage page_;
};

}  // namespace

std::string draw(const std::vector<Chart>& charts, const ChartOptions& options) {
  return ChartPage(charts, options).svg();
}

}  // namespace ddacontact
