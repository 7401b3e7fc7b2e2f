/// \file Tables of a result, read back.
#pragma once

#include <ddacontact/core/types.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ddacontact {

/// A file of comma-separated values with a header line, as CsvFile writes it.
class CsvTable {
 public:
  /// Throws Error, which names the file, when it cannot be read or a row has not as many cells as the header.
  explicit CsvTable(const std::filesystem::path& path);

  const std::vector<std::string>& header() const { return header_; }
  std::size_t n_rows() const { return rows_.size(); }
  /// The cells of a column; both throw Error when there is no such column, `numbers` also when a cell is no
  /// number.
  std::vector<std::string> texts(std::string_view column) const;
  std::vector<double> numbers(std::string_view column) const;

 private:
  std::size_t index_of(std::string_view column) const;

  std::string path_;
  std::vector<std::string> header_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace ddacontact
