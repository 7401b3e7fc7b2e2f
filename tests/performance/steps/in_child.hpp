/// \file Work in a process of its own: with memory that is its own, and that can be ended.
#pragma once

#include <functional>
#include <string>

namespace step_performance {

/// How it ended, and what it returned.
struct ChildResult {
  enum class End { done, failed, too_long } end = End::failed;
  std::string text;  ///< of `work`, or of its exception
};

/// Calls `work` in a child process, which is ended after so many seconds of the processor. Throws
/// polyfem::Error when there is no further process to be had.
ChildResult run_in_child(const std::function<std::string()>& work, int most_seconds);

}  // namespace step_performance
