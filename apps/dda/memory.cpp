#include "memory.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>
#include <ddacontact/scene/available_memory.hpp>
#include <ddacontact/scene/memory_estimate.hpp>

#include <cmath>

namespace dda {

namespace {

/// Two digits, rounded down.
double rounded_down(double number) {
  if (number < 100) return std::floor(number);
  const double unit = std::pow(10, std::floor(std::log10(number)) - 1);
  return std::floor(number / unit) * unit;
}

}  // namespace

std::optional<std::string> memory_problem(const ddacontact::Scene& scene) {
  const std::optional<double> available = ddacontact::available_memory();
  const ddacontact::MemoryEstimate estimate = ddacontact::estimate_memory(scene);
  if (!available || estimate.total() <= *available) return std::nullopt;
  const double fits = ddacontact::part_that_fits(estimate, *available);
  const auto n_blocks = static_cast<double>(scene.blocks.size());
  const std::string cure =
      n_blocks * fits >= 2
          ? fmt::format("about {:.0f} blocks like these would fit", rounded_down(n_blocks * fits))
          : fmt::format("blocks of about {:.2g} times as many cells would fit", fits);
  const std::string factor = estimate.has_factor
                                 ? fmt::format(", {} of it for the factor of their equations",
                                               ddacontact::bytes_text(estimate.factor))
                                 : ", though steps so short are taken to need no factor of their equations";
  return fmt::format("{} blocks with {:.0f} unknowns take about {} of memory{}; {} are available ({})",
                     scene.blocks.size(), estimate.n_rows, ddacontact::bytes_text(estimate.total()), factor,
                     ddacontact::bytes_text(*available), cure);
}

void keep_freed_memory() {
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

}  // namespace dda
