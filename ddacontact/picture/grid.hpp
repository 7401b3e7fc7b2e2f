/// \file Where panels and their colour bars stand on a page.
#pragma once

#include <ddacontact/core/types.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace ddacontact {

/// What the panels need; all in pixels but `extents`, the size of each one's part of its scene in m.
struct GridNeeds {
  std::vector<Vec2> extents;
  double width = 800, height = 1000;  ///< of the page; the height is a wish
  int columns = 1;
  std::vector<double> bar_widths;     ///< of the bar beside each panel; 0: none
  std::vector<std::string> captions;  ///< of each panel
  double least_row_height = 0;        ///< of the drawing part
  double below_each = 0;              ///< a line below every picture
  double above = 0, below = 0;        ///< for a title and a legend

  std::size_t n_panels() const { return extents.size(); }
};

/// Free about everything, px.
constexpr double page_margin = 12;
/// Between panels, px.
constexpr double panel_gap = 18;
/// Between a picture and its bar, px.
constexpr double bar_gap = 12;
/// Font size of captions, px.
constexpr double caption_size = 12.5;
/// From line to line of a caption, px.
constexpr double caption_line = 16;

/// Places on the page, in pixels.
struct Grid {
  double scale = 1;             ///< pixels per metre
  double drawing_width = 0;     ///< of the widest picture
  std::vector<double> heights;  ///< of each panel's picture and bar, alike in a row
  std::vector<Vec2> corners;    ///< upper left, of each panel's picture
  std::vector<Vec2> bar_corners;
  std::vector<std::vector<std::string>> captions;  ///< of each panel, broken into lines
  double width = 0, height = 0;                    ///< of the page
  double legend_top = 0;
};

/// The largest drawings that fit.
Grid arrange(const GridNeeds& needs);

/// The number of columns that makes the drawings largest; the fewest rows of several.
int best_columns(GridNeeds needs);

/// Broken at spaces into lines of at most `width` pixels, single long words aside.
std::vector<std::string> wrapped(std::string_view text, double width, double font_size);

}  // namespace ddacontact
