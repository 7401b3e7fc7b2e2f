/// \file What work takes, whoever else uses the machine.
#pragma once

#include <algorithm>
#include <ctime>
#include <functional>
#include <vector>

namespace step_performance {

/// Processor time of this thread so far, s. That of a process is coarse where it has a limit.
inline double processor_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The middle one; 0 when there is none.
inline double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Processor time of `work`, the median of so many repetitions, s.
inline double median_time(int repetitions, const std::function<void()>& work) {
  std::vector<double> seconds;
  for (int k = 0; k < repetitions; ++k) {
    const double start = processor_time();
    work();
    seconds.push_back(processor_time() - start);
  }
  return median(seconds);
}

}  // namespace step_performance
