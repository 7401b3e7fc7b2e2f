/// \file Tables and pictures of error against time.
#pragma once

#include <tests/performance/page/convergence.hpp>
#include <tests/performance/page/marked_page.hpp>

namespace benchmark_page {

/// Each method on its finest mesh: errors, rates, and where the time goes.
/// \param[in] first_error  what the error is called that stands in `Measurement::l2`
Table finest_meshes(const std::vector<Series>& all, const std::string& first_error);

/// Milliseconds to an error that all methods of first order reach, to multiples of it, and to further errors.
Table times_to_errors(const std::vector<Series>& all, const std::string& name, ErrorOf error,
                      const std::vector<double>& multiples, const std::vector<double>& further = {});

/// Errors against unknowns and against time, as SVG.
std::string work_precision_picture(const std::string& title, const std::vector<Series>& all,
                                   const std::string& first_error);

}  // namespace benchmark_page
