#include "named_files.hpp"

#include "call_error.hpp"

#include <fmt/format.h>
#include <ddacontact/output/older_results.hpp>

#include <fstream>
#include <sstream>

namespace dda {

namespace fs = std::filesystem;

namespace {

bool names_a_file(const fs::path& directory, const std::string& word) {
  std::error_code error;
  return !word.empty() && fs::is_regular_file(directory / word, error);
}

}  // namespace

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<std::string> quoted_words(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t begin = text.find_first_of("\"'"); begin != std::string::npos;) {
    const std::size_t end = text.find_first_of(std::string{text[begin], '\n'}, begin + 1);
    if (end == std::string::npos) break;
    if (text[end] != '\n') words.push_back(text.substr(begin + 1, end - begin - 1));
    begin = text.find_first_of("\"'", end + 1);
  }
  return words;
}

std::string texts_of_files(const fs::path& directory, const std::vector<std::string>& words) {
  std::string texts;
  for (const std::string& word : words)
    if (names_a_file(directory, word)) texts += '\n' + word + '\n' + text_of(directory / word);
  return texts;
}

std::vector<fs::path> files_of_scene(const fs::path& scene, const std::vector<std::string>& settings) {
  std::vector<std::string> words = quoted_words(text_of(scene));
  for (const std::string& setting : settings) words.push_back(setting.substr(setting.find('=') + 1));
  std::vector<fs::path> files{scene};
  for (const std::string& word : words)
    if (names_a_file(scene.parent_path(), word)) files.push_back(scene.parent_path() / word);
  return files;
}

void expect_none_overwritten(const fs::path& directory, const std::vector<fs::path>& files) {
  std::error_code error;
  for (const fs::path& file : files)
    if (ddacontact::is_result_file(file.filename().string()) &&
        fs::equivalent(directory / file.filename(), file, error))
      throw CallError(fmt::format(
          "the results in \"{}\" would be written over \"{}\" (name another directory for --output)",
          directory.string(), file.string()));
}

void expect_none_in(const fs::path& directory, const std::vector<fs::path>& files) {
  std::error_code error;
  const fs::path whole = fs::canonical(directory, error);
  if (error) return;  // it is not there yet
  for (const fs::path& file : files) {
    const fs::path inside = fs::weakly_canonical(file, error).lexically_relative(whole);
    if (!inside.empty() && *inside.begin() != "..")
      throw CallError(
          fmt::format("\"{}\" holds \"{}\", which would be renamed with the results of the next run (name "
                      "another directory for --output)",
                      directory.string(), file.string()));
  }
}

}  // namespace dda
