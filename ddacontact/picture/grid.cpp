#include <ddacontact/picture/grid.hpp>

#include <ddacontact/picture/svg.hpp>

#include <algorithm>

namespace ddacontact {

namespace {

constexpr double least_column_width = 90;

/// Room beside the pictures of each column.
std::vector<double> bar_slots(const GridNeeds& needs) {
  std::vector<double> slots(static_cast<std::size_t>(needs.columns), 0.);
  for (std::size_t i = 0; i < needs.bar_widths.size(); ++i) {
    double& slot = slots[i % slots.size()];
    if (needs.bar_widths[i] > 0) slot = std::max(slot, bar_gap + needs.bar_widths[i]);
  }
  return slots;
}

double sum(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

double widest(const GridNeeds& needs) {
  double width = 0;
  for (const Vec2& extent : needs.extents) width = std::max(width, extent.x());
  return width;
}

/// The panels of a row: from `first` to before `end`.
struct Row {
  std::size_t first = 0, end = 0;
  double extent = 0;  ///< the largest height, m
};

std::vector<Row> rows_of(const GridNeeds& needs) {
  std::vector<Row> rows;
  const auto columns = static_cast<std::size_t>(needs.columns);
  for (std::size_t i = 0; i < needs.n_panels(); ++i) {
    if (i % columns == 0) rows.push_back({i, i, 0});
    rows.back().end = i + 1;
    rows.back().extent = std::max(rows.back().extent, needs.extents[i].y());
  }
  return rows;
}

double scale_for(const GridNeeds& needs) {
  const std::vector<Row> rows = rows_of(needs);
  const double n_columns = needs.columns, n_rows = static_cast<double>(rows.size());
  const double beside = 2 * page_margin + (n_columns - 1) * panel_gap + sum(bar_slots(needs));
  const double above = 2 * page_margin + needs.above + needs.below +
                       n_rows * (2 * caption_line + needs.below_each) + (n_rows - 1) * panel_gap;
  double extent = 0;
  for (const Row& row : rows) extent += row.extent;
  const double width = std::max(needs.width - beside, 40 * n_columns);
  const double height = std::max(needs.height - above, 40 * n_rows);
  return std::min(width / (n_columns * widest(needs)), height / extent);
}

/// Breaks the captions of a row; returns the height they take.
double wrap_captions(const GridNeeds& needs, const Row& row, double column_width,
                     const std::vector<double>& slots, Grid& grid) {
  std::size_t n_lines = 0;
  for (std::size_t i = row.first; i < row.end; ++i) {
    grid.captions.push_back(wrapped(needs.captions[i], column_width + slots[i - row.first], caption_size));
    n_lines = std::max(n_lines, grid.captions.back().size());
  }
  return n_lines == 0 ? 0 : static_cast<double>(n_lines) * caption_line + 4;
}

}  // namespace

std::vector<std::string> wrapped(std::string_view text, double width, double font_size) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string word(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (word.empty()) continue;
    if (!lines.empty() && text_width(lines.back() + " " + word, font_size) <= width)
      lines.back() += " " + word;
    else
      lines.push_back(word);
  }
  return lines;
}

Grid arrange(const GridNeeds& needs) {
  Grid grid;
  grid.scale = scale_for(needs);
  grid.drawing_width = grid.scale * widest(needs);
  const std::vector<double> slots = bar_slots(needs);
  const double column_width = std::max(grid.drawing_width, least_column_width);
  double y = page_margin + needs.above;
  for (const Row& row : rows_of(needs)) {
    y += wrap_captions(needs, row, column_width, slots, grid);
    const double height = std::max(grid.scale * row.extent + needs.below_each, needs.least_row_height);
    double x = page_margin;
    for (std::size_t i = row.first; i < row.end; ++i) {
      grid.corners.push_back({x, y});
      grid.bar_corners.push_back({x + grid.drawing_width + bar_gap, y});
      grid.heights.push_back(height);
      x += column_width + slots[i - row.first] + panel_gap;
    }
    grid.width = std::max(grid.width, x - panel_gap + page_margin);
    y += height + panel_gap;
  }
  grid.legend_top = y - panel_gap + 2;
  grid.height = grid.legend_top + needs.below + page_margin;
  return grid;
}

int best_columns(GridNeeds needs) {
  int best = 1;
  double largest = 0;
  for (int columns = static_cast<int>(needs.n_panels()); columns >= 1; --columns) {
    needs.columns = columns;
    const double scale = scale_for(needs);
    if (scale > 1.0001 * largest) {
      largest = scale;
      best = columns;
    }
  }
  return best;
}

}  // namespace ddacontact
