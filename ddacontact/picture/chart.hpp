/// \file Line charts, as SVG.
#pragma once

#include <ddacontact/picture/svg.hpp>

#include <string>
#include <vector>

namespace ddacontact {

/// One line; both of the same length. Points that are not finite are left out.
struct Series {
  std::string name;
  std::vector<double> x, y;
  bool markers = false;  ///< diamonds instead of a line; the k-th such series has the colour of the k-th line
  bool dots = false;     ///< a dot at each point of the line
  bool guide = false;    ///< a thin grey line that has no colour of its own
};

/// Lines over one pair of axes. Linear axes get a prefix of the unit that suits the values. Logarithmic ones
/// show numbers > 0; others are left out.
struct Chart {
  Label x_symbol, y_symbol;
  std::string x_unit, y_unit;
  std::vector<Series> series;
  bool x_logarithmic = false, y_logarithmic = false;
};

/// Sizes and title of a picture of charts.
struct ChartOptions {
  std::string title{};       ///< above everything; may be empty
  double width = 640;        ///< px
  double plot_height = 210;  ///< px, of the rectangle of each chart
};

/// The whole SVG file: the charts below each other, the names of the lines beside each chart of several.
/// Throws Error when there is no chart.
std::string draw(const std::vector<Chart>& charts, const ChartOptions& options);

}  // namespace ddacontact
