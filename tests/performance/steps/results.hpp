/// \file The same measurements from what runs of the program have written.
#pragma once

#include <tests/performance/steps/measurement.hpp>

namespace step_performance {

/// Means over a run from the summary.json of its result directory. What that does not say is 0. Throws
/// polyfem::Error when there is none.
Measurement measurement_of_result(const std::filesystem::path& directory);

}  // namespace step_performance
