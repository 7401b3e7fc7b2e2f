/// \file Runs that are interrupted, and their results compared.
#pragma once

#include "program.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <set>
#include <thread>

namespace support {

/// What may differ from run to run of a summary: times, memory and what is of the last call alone.
inline std::string figures_of(const std::string& text) {
  nlohmann::json json = nlohmann::json::parse(text);
  for (const char* key : {"wall_seconds", "peak_memory_mb", "analyses", "resumed_after"}) json.erase(key);
  return json.dump();
}

class Resume : public Program {
 protected:
  /// Every file of a result but the log, which says when it was resumed.
  void expect_same_results(const std::string& one, const std::string& other) const {
    const auto files_of = [&](const std::string& directory) {
      std::set<std::string> files;
      for (const auto& entry : fs::recursive_directory_iterator(directory_ / directory))
        if (entry.is_regular_file() && entry.path().filename() != "log.txt")
          files.insert(fs::relative(entry.path(), directory_ / directory).string());
      return files;
    };
    ASSERT_EQ(files_of(one), files_of(other));
    for (const std::string& file : files_of(one)) {
      const std::string a = read_file(directory_ / one / file), b = read_file(directory_ / other / file);
      if (file == "summary.json")
        EXPECT_EQ(figures_of(a), figures_of(b));
      else
        EXPECT_TRUE(a == b) << file << " differs";
    }
  }

  /// Runs the program until it ends or `milliseconds` have passed; then it is sent the signal.
  int run_and_signal(const std::vector<std::string>& arguments, int milliseconds, int signal) const {
    const pid_t child = fork();
    if (child == 0) {
      std::vector<char*> words{const_cast<char*>(POLYDDA_PROGRAM)};
      for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
      words.push_back(nullptr);
      if (chdir(directory_.c_str()) == 0) execv(POLYDDA_PROGRAM, words.data());
      _exit(127);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    kill(child, signal);
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  /// Stops the scene after 1, 4, 5 and 8 steps and goes on, into another directory and into the same.
  void expect_any_step_to_do(const std::string& scene) {
    SCOPED_TRACE(scene);
    const std::string run = "run " + scene + " --quiet --set output.every=3";
    ASSERT_EQ(dda(run + " -o whole --steps 9"), 0) << err_;
    for (int steps : {1, 4, 5, 8}) {
      ASSERT_EQ(dda(run + " -o part --steps " + std::to_string(steps)), 0) << err_;
      ASSERT_EQ(dda(run + " -o other --steps 9 --resume part/checkpoint.bin"), 0) << err_;
      ASSERT_EQ(dda(run + " -o part --steps 9 --resume part/checkpoint.bin"), 0) << err_;
      expect_same_results("whole", "other");
      expect_same_results("whole", "part");
    }
  }
};

}  // namespace support
