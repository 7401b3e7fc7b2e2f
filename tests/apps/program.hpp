/// \file Calls the program from outside.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace support {

namespace fs = std::filesystem;

inline std::string read_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

inline std::vector<std::vector<std::string>> read_csv(const fs::path& path) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(read_file(path));
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string>& row = rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
  }
  return rows;
}

/// A directory of its own in which the program is called.
class Program : public testing::Test {
 protected:
  Program() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    directory_ =
        fs::temp_directory_path() / ("polydda_" + std::string(test->name()) + std::to_string(getpid()));
    fs::create_directories(directory_);
  }
  ~Program() override { fs::remove_all(directory_); }

  /// Runs `dda ARGUMENTS` in the test's directory; keeps what it printed.
  int dda(const std::string& arguments) {
    const std::string command = "cd '" + directory_.string() + "' && " + POLYDDA_PROGRAM " " + arguments +
                                " > '" + out_path() + "' 2> '" + err_path() + "' < /dev/null";
    const int status = std::system(command.c_str());
    out_ = read_file(out_path());
    err_ = read_file(err_path());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(directory_ / name, std::ios::binary) << text;
  }
  /// That the series of blocks lists.
  int number_of_frames(const std::string& directory) const {
    const std::string series = read_file(directory_ / directory / "results.pvd");
    int n = 0;
    for (std::size_t at = 0; (at = series.find("<DataSet", at)) != std::string::npos; ++at) ++n;
    return n;
  }
  nlohmann::json summary(const std::string& directory) const {
    return nlohmann::json::parse(read_file(directory_ / directory / "summary.json"));
  }

  fs::path directory_;
  std::string out_, err_;

 private:
  std::string out_path() const { return (directory_ / "stdout").string(); }
  std::string err_path() const { return (directory_ / "stderr").string(); }
};

}  // namespace support
