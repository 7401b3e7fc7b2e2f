#include "in_child.hpp"

#include <polyfem/core/error.hpp>

#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <exception>

namespace step_performance {

namespace {

void write_all(int file, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t n = write(file, text.data() + at, text.size() - at);
    if (n <= 0) return;
    at += static_cast<std::size_t>(n);
  }
}

[[noreturn]] void be_child(const std::function<std::string()>& work, int file) {
  int status = 0;
  std::string text;
  try {
    text = work();
  } catch (const std::exception& error) {
    text = error.what();
    status = 1;
  }
  write_all(file, text);
  _exit(status);
}

}  // namespace

ChildResult run_in_child(const std::function<std::string()>& work, double most_seconds) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw polyfem::Error("there is no pipe to be had");
  const pid_t child = fork();
  if (child < 0) throw polyfem::Error("there is no process to be had");
  if (child == 0) {
    close(ends[0]);
    be_child(work, ends[1]);
  }
  close(ends[1]);
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end =
      Clock::now() + std::chrono::milliseconds(static_cast<long>(1e3 * most_seconds));
  ChildResult result;
  bool too_long = false;
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    pollfd ready{ends[0], POLLIN, 0};
    too_long = left <= 0 || poll(&ready, 1, static_cast<int>(left)) == 0;
    if (too_long) break;
    std::array<char, 4096> part{};
    const ssize_t n = read(ends[0], part.data(), part.size());
    if (n <= 0) break;
    result.text.append(part.data(), static_cast<std::size_t>(n));
  }
  close(ends[0]);
  if (too_long) kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  if (too_long)
    result = {ChildResult::End::too_long, {}};
  else if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
    result.end = ChildResult::End::done;
  else if (result.text.empty())
    result.text = "it was ended by a signal, out of memory for one";
  return result;
}

}  // namespace step_performance
