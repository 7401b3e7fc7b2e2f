#include "named_files.hpp"

#include <fstream>
#include <sstream>

namespace dda {

namespace fs = std::filesystem;

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
  for (const std::string& word : words) {
    std::error_code error;
    if (!word.empty() && fs::is_regular_file(directory / word, error))
      texts += '\n' + word + '\n' + text_of(directory / word);
  }
  return texts;
}

}  // namespace dda
