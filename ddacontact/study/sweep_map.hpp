/// \file Results of a sweep over two settings as a map of coloured cells.
#pragma once

#include <filesystem>
#include <string>

namespace ddacontact {

/// Columns of sweep.csv: `value` over `x` to the right and `y` upwards.
struct MapColumns {
  std::string x, y, value;
};

/// "X,Y,VALUE". Throws Error for anything else.
MapColumns parse_map(const std::string& text);

/// SVG: a cell for each pair of different numbers in `x` and `y`, evenly spaced in ascending order. Cells of
/// several cases show the mean; those without a number are left white, and say so where a case failed. Throws
/// Error when a column is not there or no row has three numbers.
std::string map_of(const std::filesystem::path& table, const MapColumns& columns);

}  // namespace ddacontact
