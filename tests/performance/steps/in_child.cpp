#include "in_child.hpp"

#include <polyfem/core/error.hpp>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
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

[[noreturn]] void be_child(const std::function<std::string()>& work, rlim_t most_seconds, int file) {
  const rlimit limit{most_seconds, most_seconds};
  setrlimit(RLIMIT_CPU, &limit);
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

ChildResult run_in_child(const std::function<std::string()>& work, int most_seconds) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw polyfem::Error("there is no pipe to be had");
  const pid_t child = fork();
  if (child < 0) throw polyfem::Error("there is no process to be had");
  if (child == 0) {
    close(ends[0]);
    be_child(work, static_cast<rlim_t>(most_seconds), ends[1]);
  }
  close(ends[1]);
  ChildResult result;
  std::array<char, 4096> part{};
  for (ssize_t n = 0; (n = read(ends[0], part.data(), part.size())) > 0;)
    result.text.append(part.data(), static_cast<std::size_t>(n));
  close(ends[0]);
  int status = 0;
  rusage used{};
  wait4(child, &status, 0, &used);
  if (WIFEXITED(status)) {
    if (WEXITSTATUS(status) == 0) result.end = ChildResult::End::done;
  } else if (used.ru_utime.tv_sec + used.ru_stime.tv_sec + 1 >= most_seconds) {
    result.end = ChildResult::End::too_long;
  } else {
    result.text = "it was ended by a signal, out of memory for one";
  }
  return result;
}

}  // namespace step_performance
