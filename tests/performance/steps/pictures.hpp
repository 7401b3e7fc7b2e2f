/// \file Pictures of measurements.
#pragma once

#include <tests/performance/steps/measurement.hpp>

#include <span>
#include <string>
#include <vector>

namespace step_performance {

/// Rows that differ in size alone, ascending.
struct SizeSeries {
  std::string name;  ///< "wall, settled, 0.01 s"
  std::vector<Measurement> rows;
};
/// The rows that were measured, grouped, in the order of the table.
std::vector<SizeSeries> size_series(std::span<const Measurement> table);

/// Time per block and step over the number of blocks, by phase, with what CHOLMOD takes for one factor: SVG.
std::string phase_picture(const SizeSeries& series);
/// The whole time per block and step of several series: SVG.
std::string total_picture(const std::string& title, std::span<const SizeSeries> all);

}  // namespace step_performance
