/// \file What was aimed at, and what is seen.
#pragma once

#include <tests/performance/steps/page_tables.hpp>

namespace step_performance {

/// A row for each figure: aim, figure, pass or miss.
benchmark_page::Table bars_table(const Tables& tables);

}  // namespace step_performance
