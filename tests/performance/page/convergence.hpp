/// \file Series of measurements under refinement: rates, and the time that an error takes.
#pragma once

#include <tests/performance/work_precision/measurement_table.hpp>

#include <optional>
#include <string>
#include <vector>

namespace benchmark_page {

using work_precision::Measurement;

/// One of the two errors of a measurement.
using ErrorOf = double Measurement::*;

/// One method on meshes of growing fineness, each solved by the fastest of its solvers.
struct Series {
  std::string method;
  std::vector<Measurement> levels;

  bool of_polyfem() const { return method.starts_with("polyfem"); }
};

/// The series of a problem, in the order of the table.
std::vector<Series> series_of(const std::vector<Measurement>& table, const std::string& problem);

/// The order p of error ~ h^p with h = cells^(-1/2): the slope of the line nearest to all levels, in
/// logarithms.
double rate(const Series& series, ErrorOf error);

/// Seconds for an error, on the line between the levels in logarithms; nothing when no level is as accurate.
/// What is more accurate on its coarsest mesh takes as long as that.
std::optional<double> time_to_reach(const Series& series, ErrorOf error, double wanted);

}  // namespace benchmark_page
