/// \file The text of a page of doc/verification and its pictures, as they are made.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace verification {

/// What is said or asked of results, and what is seen here.
struct Claim {
  std::string said;
  bool seen;
  std::string here;  ///< the figures, and the reason where it is not seen
};

class Report {
 public:
  /// Pictures and text go to `directory`. `claims_of`: the header of what is said, "the paper says".
  Report(std::filesystem::path directory, std::string claims_of)
      : directory_(std::move(directory)), claims_of_(std::move(claims_of)) {}

  void heading(const std::string& text) { text_ += "\n## " + text + "\n\n"; }
  void paragraph(const std::string& text) { text_ += text + "\n\n"; }
  /// The first row is the header.
  void table(const std::vector<std::vector<std::string>>& rows);
  /// Writes `svg` to `name`.svg and shows it.
  void picture(const std::string& name, const std::string& svg, const std::string& caption);
  void claims(const std::vector<Claim>& claims);

  int n_claims() const { return n_claims_; }
  int n_seen() const { return n_seen_; }
  /// Writes `name`.md: `front`, then everything that was added. Throws Error when it cannot.
  void write(const std::string& name, const std::string& front) const;

 private:
  std::filesystem::path directory_;
  std::string claims_of_, text_;
  int n_claims_ = 0, n_seen_ = 0;
};

}  // namespace verification
