/// \file What one run took and how wrong its answer was.
#pragma once

#include <tests/performance/error_time/problem.hpp>

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace error_time {

/// A run of a problem by a method, judged by one quantity.
struct Measurement {
  std::string problem, quantity, method;
  double setting = 0;
  double seconds = 0;  ///< of the steps, by the processor's clock, one thread: the median
  double error = std::numeric_limits<double>::quiet_NaN();  ///< relative; NaN: the run did not end
  long steps = 0, substeps = 0, rejected = 0;
  long solutions = 0;     ///< of (13), in all tries
  std::string stopped{};  ///< why the run did not end
};

/// One for each quantity. Runs shorter than two seconds are repeated: three times, up to nine if they are
/// very short.
std::vector<Measurement> measure(const Problem& problem, const Judge& judge, const Method& method,
                                 double setting, bool repeat = true);
/// All problems, or the one of that name. Of a method whose run takes more than 2 s no dearer one is made.
/// `tell` is called with every measurement.
std::vector<Measurement> measure_all(const std::string& only,
                                     const std::function<void(const Measurement&)>& tell);

/// Comma-separated, with a line of names. Throws polyfem::Error when it cannot.
void write_table(const std::filesystem::path& path, const std::vector<Measurement>& measurements);
/// Throws polyfem::Error for a file that is missing or that `write_table` has not written.
std::vector<Measurement> read_table(const std::filesystem::path& path);

}  // namespace error_time
