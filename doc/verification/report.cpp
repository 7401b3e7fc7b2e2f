#include "report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <polyfem/core/error.hpp>

#include <algorithm>
#include <fstream>

namespace verification {

namespace {

void write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw polyfem::Error("cannot write \"" + path.string() + "\"");
}

/// What fmt prints of NaN: no comparison with it fails that asks for the larger of two.
bool is_nan(const std::string& cell) {
  return cell == "nan" || cell == "-nan";
}

}  // namespace

void Report::table(const std::vector<std::vector<std::string>>& rows) {
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (std::ranges::any_of(rows[r], is_nan))
      throw polyfem::Error(
          fmt::format("a table with a figure that is no number: {}", fmt::join(rows[r], ", ")));
    text_ += fmt::format("| {} |\n", fmt::join(rows[r], " | "));
    for (std::size_t column = 0; r == 0 && column < rows[r].size(); ++column) text_ += "|---";
    if (r == 0) text_ += "|\n";
  }
  text_ += '\n';
}

void Report::picture(const std::string& name, const std::string& svg, const std::string& caption) {
  write_file(directory_ / (name + ".svg"), svg);
  text_ += fmt::format("![{}]({}.svg)\n\n*{}*\n\n", caption, name, caption);
}

void Report::claims(const std::vector<Claim>& claims) {
  std::vector<std::vector<std::string>> rows{{claims_of_, "pass", "value"}};
  for (const Claim& claim : claims) {
    rows.push_back({claim.said, claim.seen ? "yes" : "**no**", claim.here});
    ++n_claims_;
    n_seen_ += claim.seen;
  }
  table(rows);
}

void Report::write(const std::string& name, const std::string& front) const {
  write_file(directory_ / (name + ".md"), front + text_);
}

}  // namespace verification
