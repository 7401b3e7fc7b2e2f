#include <ddacontact/study/sweep_map.hpp>

#include <ddacontact/output/csv_table.hpp>
#include <ddacontact/picture/number_text.hpp>
#include <ddacontact/picture/svg.hpp>
#include <ddacontact/study/sweep_results.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace ddacontact {

namespace {

constexpr double margin = 12, text_size = 11, label_size = 12, tick_gap = 6, bar_width = 14, bar_gap = 18;
constexpr double map_width = 480, map_height = 360;
constexpr int n_bands = 10;
const Colour dark{34, 34, 34};

struct Mean {
  double sum = 0;
  int n = 0;
  double value() const { return sum / n; }
};

class Map {
 public:
  Map(const CsvTable& table, const MapColumns& columns) : columns_(columns) {
    const std::vector<std::string> xs = table.texts(columns.x), ys = table.texts(columns.y),
                                   values = table.texts(columns.value), status = table.texts("status");
    for (std::size_t k = 0; k < values.size(); ++k) {
      const auto x = number_of(xs[k]), y = number_of(ys[k]), value = number_of(values[k]);
      if (!x || !y) continue;
      column_[*x] = row_[*y] = 0;
      if (status[k] == "failed") failed_.insert({*x, *y});
      if (!value || status[k] == "failed") continue;
      Mean& mean = cells_[{*x, *y}];
      mean.sum += *value;
      ++mean.n;
    }
    if (cells_.empty())
      throw Error("no case has numbers in all columns \"" + columns.x + "\", \"" + columns.y + "\" and \"" +
                  columns.value + "\"");
    for (auto* axis : {&column_, &row_}) {
      int place = 0;
      for (auto& [at, index] : *axis) index = place++;
    }
    low_ = high_ = cells_.begin()->second.value();
    for (const auto& [at, mean] : cells_) {
      low_ = std::min(low_, mean.value());
      high_ = std::max(high_, mean.value());
    }
    cell_ = {map_width / static_cast<double>(column_.size()), map_height / static_cast<double>(row_.size())};
    double widest = 0;
    for (const auto& [at, index] : row_) widest = std::max(widest, text_width(short_text(at), text_size));
    corner_ = {margin + label_size + 8 + widest + tick_gap, margin + label_size + 10};
  }

  std::string svg() {
    page_.text(corner_ - Vec2(0, 8), columns_.value + (any_mean() ? ", mean of the cases of each cell" : ""),
               {.size = label_size, .bold = true});
    draw_cells();
    draw_ticks();
    draw_bar();
    return page_.finish(corner_.x() + map_width + bar_gap + bar_width + 5 + bar_text_width() + margin,
                        corner_.y() + map_height + 2 * text_size + label_size + margin + tick_gap);
  }

 private:
  static std::string short_text(double value) { return number_text(value, 4); }
  static double bar_text_width() { return text_width("0.0000000", text_size); }

  bool any_mean() const {
    return std::ranges::any_of(cells_, [](const auto& cell) { return cell.second.n > 1; });
  }
  /// 0 .. n_bands - 1.
  int band(double value) const {
    return high_ > low_ ? std::min(n_bands - 1, static_cast<int>(n_bands * (value - low_) / (high_ - low_)))
                        : 0;
  }
  static Colour colour(int band) { return sequential_colour((band + 0.5) / n_bands); }

  Vec2 place_of(const std::pair<double, double>& at) const {
    return corner_ +
           Vec2(column_.at(at.first) * cell_.x(), map_height - (row_.at(at.second) + 1) * cell_.y());
  }
  bool has_room(const std::string& text) const {
    return text_width(text, text_size) + 6 <= cell_.x() && text_size + 4 <= cell_.y();
  }
  void write_in_cell(const Vec2& place, const std::string& text, const Colour& ink) {
    if (has_room(text))
      page_.text(place + cell_ / 2 + Vec2(0, 0.35 * text_size), text,
                 {.size = text_size, .anchor = Anchor::middle, .colour = ink});
  }

  void draw_cells() {
    for (const auto& at : failed_)
      if (!cells_.contains(at)) write_in_cell(place_of(at), "failed", dark);
    for (const auto& [at, mean] : cells_) {
      const Vec2 place = place_of(at);
      const int shade = band(mean.value());
      page_.rectangle(place, cell_,
                      "fill=\"" + hex(colour(shade)) + "\" stroke=\"#fff\" stroke-width=\"0.5\"");
      write_in_cell(place, number_text(mean.value(), 3), shade < n_bands / 2 ? dark : Colour{255, 255, 255});
    }
    page_.rectangle(corner_, {map_width, map_height}, "fill=\"none\" stroke=\"#222\" stroke-width=\"0.8\"");
  }

  /// As many values as have room.
  void draw_ticks() {
    double widest = 0;
    for (const auto& [at, index] : column_) widest = std::max(widest, text_width(short_text(at), text_size));
    const int every_column = static_cast<int>(std::ceil((widest + 8) / cell_.x())),
              every_row = static_cast<int>(std::ceil((text_size + 3) / cell_.y()));
    const double below = corner_.y() + map_height;
    for (const auto& [at, index] : column_)
      if (index % every_column == 0)
        page_.text({corner_.x() + (index + 0.5) * cell_.x(), below + text_size + 4}, short_text(at),
                   {.size = text_size, .anchor = Anchor::middle});
    for (const auto& [at, index] : row_)
      if (index % every_row == 0)
        page_.text({corner_.x() - tick_gap, below - (index + 0.5) * cell_.y() + 0.35 * text_size},
                   short_text(at), {.size = text_size, .anchor = Anchor::end});
    page_.text({corner_.x() + map_width / 2, below + 2 * text_size + label_size}, columns_.x,
               {.size = label_size, .anchor = Anchor::middle});
    page_.text({margin + label_size - 2, corner_.y() + map_height / 2}, columns_.y,
               {.size = label_size, .anchor = Anchor::middle, .upwards = true});
  }

  void draw_bar() {
    const double x = corner_.x() + map_width + bar_gap, height = map_height / n_bands;
    const int n = high_ > low_ ? n_bands : 1;
    for (int k = 0; k < n; ++k)
      page_.rectangle({x, corner_.y() + map_height - (k + 1) * height}, {bar_width, height},
                      "fill=\"" + hex(colour(k)) + "\"");
    for (int k = 0; k <= (n == 1 ? 0 : n); ++k)
      page_.text({x + bar_width + 5, corner_.y() + map_height - k * height + 0.35 * text_size},
                 number_text(low_ + (high_ - low_) * k / n_bands, 3), {.size = text_size});
  }

  MapColumns columns_;
  std::map<double, int> column_, row_;  ///< places of the numbers
  std::map<std::pair<double, double>, Mean> cells_;
  std::set<std::pair<double, double>> failed_;
  double low_ = 0, high_ = 0;
  Vec2 cell_, corner_;  ///< px
  SvgPage page_;
};

}  // namespace

MapColumns parse_map(const std::string& text) {
  const std::size_t first = text.find(','), last = text.rfind(',');
  if (first == 0 || first == std::string::npos || last <= first + 1 || last + 1 == text.size() ||
      text.find(',', first + 1) != last)
    throw Error("--map \"" + text + "\" names no three columns (write X,Y,VALUE)");
  return {text.substr(0, first), text.substr(first + 1, last - first - 1), text.substr(last + 1)};
}

std::string map_of(const std::filesystem::path& table, const MapColumns& columns) {
  return Map(CsvTable(table), columns).svg();
}

}  // namespace ddacontact
