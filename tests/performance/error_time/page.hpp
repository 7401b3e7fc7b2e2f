/// \file The page that shows the measurements.
#pragma once

#include <tests/performance/error_time/measurement.hpp>

#include <filesystem>

namespace error_time {

/// Writes `directory`/dda_accuracy.md and a picture dda_accuracy_QUANTITY.svg for each quantity.
void write_page(const std::filesystem::path& directory, const std::vector<Measurement>& all);

}  // namespace error_time
