#include "memory.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>
#include <ddacontact/scene/memory_estimate.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

namespace dda {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The number after a word at the beginning of a line, as in "MemAvailable:   1234 kB".
std::optional<double> number_after(const std::string& file, const std::string& word) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string first;
    double number = 0;
    if (words >> first && first == word && words >> number) return number;
  }
  return std::nullopt;
}

/// The number that a file begins with; nothing for "max".
std::optional<double> number_in(const std::string& file) {
  std::ifstream in(file);
  double number = 0;
  if (in >> number) return number;
  return std::nullopt;
}

/// What a control group leaves; pages of files that it may drop do not count as used.
double left_in_group(const std::string& folder, const char* limit_file, const char* usage_file,
                     const char* droppable) {
  const auto limit = number_in(folder + limit_file), used = number_in(folder + usage_file);
  if (!limit || !used) return infinity;
  return *limit - *used + number_after(folder + "memory.stat", droppable).value_or(0);
}

/// Of the group that the program is in and of those around it, in both versions of control groups.
double left_in_groups() {
  double left = infinity;
  std::ifstream in("/proc/self/cgroup");
  for (std::string line; std::getline(in, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const bool unified = controllers.empty();
    if (!unified && controllers != "memory") continue;
    const std::string root = unified ? "/sys/fs/cgroup" : "/sys/fs/cgroup/memory";
    for (std::string path = line.substr(second + 1);; path.resize(path.rfind('/'))) {
      if (path == "/") path.clear();
      left = std::min(
          left, unified ? left_in_group(root + path + '/', "memory.max", "memory.current", "inactive_file")
                        : left_in_group(root + path + '/', "memory.limit_in_bytes", "memory.usage_in_bytes",
                                        "total_inactive_file"));
      if (path.find('/') == std::string::npos) break;
    }
  }
  return left;
}

double left_of_address_space() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return infinity;
  const double used = number_in("/proc/self/statm").value_or(0) * static_cast<double>(sysconf(_SC_PAGESIZE));
  return static_cast<double>(limit.rlim_cur) - used;
}

/// Two digits, rounded down.
double rounded_down(double number) {
  if (number < 100) return std::floor(number);
  const double unit = std::pow(10, std::floor(std::log10(number)) - 1);
  return std::floor(number / unit) * unit;
}

}  // namespace

std::optional<double> available_memory() {
  const double system = number_after("/proc/meminfo", "MemAvailable:").value_or(infinity) * 1024;
  const double left = std::min({system, left_in_groups(), left_of_address_space()});
  return std::isfinite(left) ? std::optional(std::max(left, 0.0)) : std::nullopt;
}

std::string bytes_text(double bytes) {
  return bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6) : fmt::format("{:.1f} GB", bytes / 1e9);
}

std::optional<std::string> memory_problem(const ddacontact::Scene& scene) {
  const std::optional<double> available = available_memory();
  const ddacontact::MemoryEstimate estimate = ddacontact::estimate_memory(scene);
  if (!available || estimate.total() <= *available) return std::nullopt;
  const double fits = ddacontact::part_that_fits(estimate, *available);
  const auto n_blocks = static_cast<double>(scene.blocks.size());
  const std::string cure =
      n_blocks * fits >= 2
          ? fmt::format("about {:.0f} blocks like these would fit", rounded_down(n_blocks * fits))
          : fmt::format("blocks of about {:.2g} times as many cells would fit", fits);
  const std::string factor =
      estimate.has_factor
          ? fmt::format(", {} of it for the factor of their equations", bytes_text(estimate.factor))
          : ", though steps so short are taken to need no factor of their equations";
  return fmt::format("{} blocks with {:.0f} unknowns take about {} of memory{}; {} are available ({})",
                     scene.blocks.size(), estimate.n_rows, bytes_text(estimate.total()), factor,
                     bytes_text(*available), cure);
}

}  // namespace dda
