#include <ddacontact/study/job_queue.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace {

using namespace ddacontact;

/// Jobs end in any order: here the one that runs longest, or the youngest.
TEST(JobQueue, KeepsAllPlacesTakenWhileJobsWait) {
  for (const std::size_t at_once : {1u, 2u, 3u, 50u})
    for (const bool oldest_ends : {true, false}) {
      std::vector<int> jobs(20), started, running;
      std::iota(jobs.begin(), jobs.end(), 1);
      run_jobs(
          jobs, at_once,
          [&](int job) {
            started.push_back(job);
            running.push_back(job);
            EXPECT_LE(running.size(), at_once);
          },
          [&] {
            EXPECT_EQ(running.size(), std::min(at_once, running.size() + jobs.size() - started.size()));
            running.erase(oldest_ends ? running.begin() : running.end() - 1);
          });
      EXPECT_EQ(started, jobs);
      EXPECT_TRUE(running.empty());
    }
}

TEST(JobQueue, OfNoJobsWaitsForNothing) {
  run_jobs(
      {}, 2, [](int) { FAIL(); }, [] { FAIL(); });
}

}  // namespace
