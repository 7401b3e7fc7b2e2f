/// \file doc/verification/stability.md as it is made: a row of the table and a chapter for each thing asked.
#pragma once

#include <doc/verification/report.hpp>

#include <map>
#include <string>
#include <vector>

namespace stability {

using verification::Claim;
using verification::Report;

/// What is asked, when it passes, and which tests ask for it too.
struct Row {
  std::string test, passes_when, where;
};

/// A figure that the long suite has recorded.
struct Recorded {
  std::string figures;
  bool passes = false;
};
/// By name; a file of lines `name,passes,figures`. Throws Error when it cannot be read.
using LongRecord = std::map<std::string, Recorded>;
LongRecord read_long_record(const std::string& path);

class Page {
 public:
  Page(const std::string& directory, LongRecord recorded)
      : report_(directory, "requirement"), recorded_(std::move(recorded)) {}

  /// Begins a row: a heading, when it passes, where else it is tested. Returns what to add to.
  Report& begin(const Row& row);
  void claims(const std::vector<Claim>& claims);
  /// A claim of another page of doc/verification: the first line there that says so. Throws Error: none does.
  static Claim quoted(const std::string& page, const std::string& said);
  /// What the long suite recorded, as a claim; not seen when it has not.
  Claim recorded(const std::string& said, const std::string& name) const;
  void write(const std::string& front) const;

 private:
  struct Summary {
    Row row;
    int claims = 0, seen = 0;
  };
  Report report_;
  LongRecord recorded_;
  std::vector<Summary> rows_;
};

/// A number as figures show it: two digits.
std::string figure(double value);

}  // namespace stability
