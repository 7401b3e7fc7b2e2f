// The same bytes whatever the number of threads.
#include "chapters.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <polyfem/core/error.hpp>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

namespace stability {

namespace {

namespace fs = std::filesystem;

/// A directory that goes when it is done with.
class Scratch {
 public:
  Scratch() : path_(fs::temp_directory_path() / fmt::format("polydda_stability_{}", getpid())) {
    fs::create_directories(path_);
  }
  ~Scratch() { fs::remove_all(path_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::string bytes(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// What is in a result directory, by file; times and memory aside.
std::map<std::string, std::string> results(const fs::path& directory) {
  std::map<std::string, std::string> files;
  for (const auto& file : fs::recursive_directory_iterator(directory)) {
    if (!file.is_regular_file()) continue;
    std::string content = bytes(file.path());
    if (file.path().filename() == "summary.json") {
      nlohmann::json summary = nlohmann::json::parse(content);
      summary.erase("wall_seconds");
      summary.erase("peak_memory_mb");
      content = summary.dump();
    }
    files[fs::relative(file.path(), directory).string()] = content;
  }
  return files;
}

}  // namespace

void threads(Page& page) {
  Report& report = page.begin({"1 and 2 threads, 10 runs", "the same bytes",
                               "`Invariance.TwoRunsGiveTheSameBits`, `ResultDirectory*`"});
  constexpr int n_runs = 10;
  struct Example {
    const char *name, *options;
  };
  const Example examples[] = {{"sliding_15", "--set analysis.preset=default"},
                              {"arch_friction30", "--set output.refine=2"},
                              {"voronoi_push", "--steps 5"}};
  report.paragraph(
      "`dda run` with `--threads 1` and `--threads 2`, ten times each: every file of the result directory "
      "but for "
      "`wall_seconds` and `peak_memory_mb`.");
  const Scratch scratch;
  int other = 0, files = 0;
  for (const Example& example : examples) {
    std::map<std::string, std::string> first;
    for (int k = 0; k < 2 * n_runs; ++k) {
      const fs::path out = scratch.path() / "out";
      fs::remove_all(out);
      const std::string command = fmt::format(
          "'{}' run '{}/paper/{}.toml' {} --threads {} --quiet -o '{}' > /dev/null 2>&1", POLYDDA_PROGRAM,
          POLYDDA_EXAMPLES, example.name, example.options, 1 + k % 2, out.string());
      if (std::system(command.c_str()) != 0) throw polyfem::Error("failed: " + command);
      const auto now = results(out);
      if (k == 0) {
        first = now;
        files += static_cast<int>(first.size());
      } else {
        other += now != first;
      }
    }
  }
  page.claims({{"The same bytes.", other == 0,
                fmt::format("{} of {} runs of {} scenes have other ones than the first; {} files each time",
                            other, 2 * n_runs * std::size(examples), std::size(examples), files)}});
}

}  // namespace stability
