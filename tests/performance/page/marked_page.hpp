/// \file A page written by hand with parts that a program fills in.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace benchmark_page {

/// Rows of cells; the first one is the header.
using Table = std::vector<std::vector<std::string>>;

/// A table in Markdown, numbers to the right (all columns but the first).
std::string markdown(const Table& table);

/// Markdown with places for generated text, each between a line `<!-- NAME -->` and the next line `<!-- end
/// -->`.
class MarkedPage {
 public:
  /// Throws polyfem::Error when the file cannot be read.
  explicit MarkedPage(std::filesystem::path path);

  /// Puts text into a place instead of what is there. Throws polyfem::Error when the page has no such place.
  void fill(const std::string& name, const std::string& text);
  /// Throws polyfem::Error when the file cannot be written.
  void write() const;

 private:
  std::filesystem::path path_;
  std::string text_;
};

}  // namespace benchmark_page
