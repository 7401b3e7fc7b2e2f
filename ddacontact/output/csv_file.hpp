/// \file Tables as comma-separated values.
#pragma once

#include <ddacontact/output/result_marks.hpp>

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ddacontact {

/// Numbers carry 17 significant digits, enough to read back the same double, and no minus before a zero; text
/// is quoted where it must be.
class CsvFile {
 public:
  /// Creates the file with its header line. Throws OutputError when it cannot.
  CsvFile(const std::string& path, std::string_view header);
  /// Goes on with the beginning of `source`, which may be the file itself, when it is as `mark` says;
  /// otherwise begins anew, see `goes_on`. Throws OutputError.
  CsvFile(const std::string& path, std::string_view header, const std::filesystem::path& source,
          const FileMark& mark);

  bool goes_on() const { return goes_on_; }
  /// What has been written, which is in the file then. Throws OutputError.
  FileMark mark();

  template <class... Cells>
  void row(const Cells&... cells) {
    line_.clear();
    first_cell_ = true;
    (append(cells), ...);
    write_line();
  }
  /// Flushes and checks that everything was written. Throws OutputError.
  void close();

 private:
  void append(double value);
  /// An empty cell where there is no number.
  void append(const std::optional<double>& value);
  void append(long value);
  void append(int value) { append(static_cast<long>(value)); }
  void append(std::string_view text);
  void append(const std::vector<std::string>& cells) {
    for (const std::string& cell : cells) append(std::string_view(cell));
  }
  void separate();
  void write_line();

  std::string path_, line_;
  bool first_cell_ = true, goes_on_ = false;
  FileMark mark_;
  std::ofstream file_;
};

}  // namespace ddacontact
