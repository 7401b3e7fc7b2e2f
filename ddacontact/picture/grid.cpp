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

int n_rows(const GridNeeds& needs) {
  return (needs.n_panels + needs.columns - 1) / needs.columns;
}

double scale_for(const GridNeeds& needs) {
  const double columns = needs.columns, rows = n_rows(needs);
  const double beside = 2 * page_margin + (columns - 1) * panel_gap + sum(bar_slots(needs));
  const double above =
      2 * page_margin + needs.above + needs.below + rows * 2 * caption_line + (rows - 1) * panel_gap;
  const double width = std::max((needs.width - beside) / columns, 40.);
  const double height = std::max((needs.height - above) / rows, 40.);
  return std::min(width / needs.extent.x(), height / needs.extent.y());
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
  grid.drawing = grid.scale * needs.extent;
  grid.row_height = std::max(grid.drawing.y(), needs.least_row_height);
  const std::vector<double> slots = bar_slots(needs);
  const double column_width = std::max(grid.drawing.x(), least_column_width);

  double y = page_margin + needs.above;
  for (int first = 0; first < needs.n_panels; first += needs.columns) {
    const int end = std::min(first + needs.columns, needs.n_panels);
    std::size_t n_lines = 0;
    for (int i = first; i < end; ++i) {
      const auto panel = static_cast<std::size_t>(i);
      const double slot = slots[static_cast<std::size_t>(i - first)];
      grid.captions.push_back(wrapped(needs.captions[panel], column_width + slot, caption_size));
      n_lines = std::max(n_lines, grid.captions.back().size());
    }
    if (n_lines > 0) y += static_cast<double>(n_lines) * caption_line + 4;
    double x = page_margin;
    for (int i = first; i < end; ++i) {
      grid.corners.push_back({x, y});
      grid.bar_corners.push_back({x + grid.drawing.x() + bar_gap, y});
      x += column_width + slots[static_cast<std::size_t>(i - first)] + panel_gap;
    }
    grid.width = std::max(grid.width, x - panel_gap + page_margin);
    y += grid.row_height + panel_gap;
  }
  grid.legend_top = y - panel_gap + 2;
  grid.height = grid.legend_top + needs.below + page_margin;
  return grid;
}

int best_columns(GridNeeds needs) {
  int best = 1;
  double largest = 0;
  for (int columns = needs.n_panels; columns >= 1; --columns) {
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
