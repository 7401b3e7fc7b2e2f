#include <ddacontact/study/job_queue.hpp>

namespace ddacontact {

void run_jobs(const std::vector<int>& jobs, std::size_t at_once, const std::function<void(int job)>& start,
              const std::function<void()>& wait_one) {
  std::size_t n_running = 0;
  auto next = jobs.begin();
  while (next != jobs.end() || n_running > 0) {
    for (; next != jobs.end() && n_running < at_once; ++next, ++n_running) start(*next);
    wait_one();
    --n_running;
  }
}

}  // namespace ddacontact
