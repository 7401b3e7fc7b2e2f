#include <tests/performance/page/marked_page.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <polyfem/core/error.hpp>

#include <fstream>
#include <sstream>

namespace benchmark_page {

std::string markdown(const Table& table) {
  std::string text;
  for (std::size_t r = 0; r < table.size(); ++r) {
    text += fmt::format("| {} |\n", fmt::join(table[r], " | "));
    if (r > 0) continue;
    text += "|---";
    for (std::size_t column = 1; column < table[r].size(); ++column) text += "|---:";
    text += "|\n";
  }
  return text;
}

MarkedPage::MarkedPage(std::filesystem::path path) : path_(std::move(path)) {
  std::ifstream file(path_, std::ios::binary);
  std::ostringstream content;
  content << file.rdbuf();
  if (!file) throw polyfem::Error("cannot read \"" + path_.string() + "\"");
  text_ = content.str();
}

void MarkedPage::fill(const std::string& name, const std::string& text) {
  const std::string mark = "<!-- " + name + " -->\n", end_mark = "<!-- end -->";
  const std::size_t mark_at = text_.find(mark), begin = mark_at + mark.size();
  const std::size_t end = mark_at == std::string::npos ? mark_at : text_.find(end_mark, begin);
  if (end == std::string::npos)
    throw polyfem::Error("\"" + path_.string() + "\" has no lines \"<!-- " + name + " -->\" and \"" +
                         end_mark + "\"");
  text_.replace(begin, end - begin, text);
}

void MarkedPage::write() const {
  std::ofstream file(path_, std::ios::binary);
  file << text_;
  file.close();
  if (!file) throw polyfem::Error("cannot write \"" + path_.string() + "\"");
}

}  // namespace benchmark_page
