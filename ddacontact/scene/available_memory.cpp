#include <ddacontact/scene/available_memory.hpp>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

namespace ddacontact {

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

}  // namespace

std::optional<double> available_memory() {
  const double system = number_after("/proc/meminfo", "MemAvailable:").value_or(infinity) * 1024;
  const double left = std::min({system, left_in_groups(), left_of_address_space()});
  return std::isfinite(left) ? std::optional(std::max(left, 0.0)) : std::nullopt;
}

}  // namespace ddacontact
