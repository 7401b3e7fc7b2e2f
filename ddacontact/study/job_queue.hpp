/// \file Jobs in processes of their own, some at a time.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace ddacontact {

/// Starts the jobs in their order, the next one as soon as one ends: while jobs wait, `at_once` of them run.
/// \param[in] start     begins a job and returns at once
/// \param[in] wait_one  waits until one of those that run ends
void run_jobs(const std::vector<int>& jobs, std::size_t at_once, const std::function<void(int job)>& start,
              const std::function<void()>& wait_one);

}  // namespace ddacontact
