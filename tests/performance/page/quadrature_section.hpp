/// \file Tables and a picture of how many points an accuracy takes, from what quadrature_performance prints.
#pragma once

#include <tests/performance/page/marked_page.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace benchmark_page {

/// Fields by the names in the first line.
using Row = std::map<std::string, std::string>;

/// Comma-separated rows. Throws polyfem::Error for a file without rows.
std::vector<Row> read_rows(const std::filesystem::path& path);

/// Median errors of K of hexagons and of 12-gons against points, and of hexagons against time, one line for
/// each family of rules, as SVG. Throws polyfem::Error when a family is missing.
std::string quadrature_picture(const std::vector<Row>& rules);

/// Error of K by the paper's rule and points for tolerances, by the number of vertices.
Table points_table(const std::vector<Row>& rules);

/// How often a requested tolerance was kept, and what it took.
Table tolerance_table(const std::vector<Row>& tolerances);

}  // namespace benchmark_page
