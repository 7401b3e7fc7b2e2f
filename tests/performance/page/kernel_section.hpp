/// \file Times of small functions, as Google Benchmark reports them.
#pragma once

#include <tests/performance/page/marked_page.hpp>

#include <filesystem>
#include <map>
#include <string>

namespace benchmark_page {

/// Nanoseconds of processor time by the name of the benchmark.
using KernelTimes = std::map<std::string, double>;

/// Medians of the repetitions in a file that `--benchmark_out` has written. Throws polyfem::Error when it
/// cannot be read.
KernelTimes kernel_times(const std::filesystem::path& path);

/// One stiffness matrix of a quadrilateral, here and by deal.II.
Table quadrilateral_table(const KernelTimes& times);

/// The steps to an element matrix for polygons of several sizes.
Table element_table(const KernelTimes& times);

/// Functions of a basis, ns a point in batches of 16, beside CGAL's, compiled alike: with the project's flags
/// and for the processor at hand.
/// \param[in] basis  its name in the benchmarks
Table basis_table(const std::string& basis, const KernelTimes& generic, const KernelTimes& native);

}  // namespace benchmark_page
