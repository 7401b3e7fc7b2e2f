/// \file The arrays of a .vtu file in any of VTK's encodings, as numbers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace polyfem {

/// A file in memory, of other programs too: ASCII, base64 or appended data, raw or base64, plain or deflated
/// by zlib, headers of UInt32 or UInt64, numbers of any type; one piece, little endian. `VtuReader` reads the
/// form that VtuFile writes, with its types, and is faster. Everything throws FileError with file, line
/// and cure.
class VtuArrays {
 public:
  explicit VtuArrays(const std::filesystem::path& path);

  std::size_t n_points() const { return n_points_; }
  std::size_t n_cells() const { return n_cells_; }

  /// Names of the arrays in "Points", "Cells", "PointData", "CellData" or "FieldData".
  std::vector<std::string> names(const std::string& section) const;
  /// All numbers of an array, which must be there.
  std::vector<double> reals(const std::string& section, const std::string& name) const;
  /// The same of an array of whole numbers.
  std::vector<std::int64_t> whole_numbers(const std::string& section, const std::string& name) const;

  /// The line of an array, or of its section when there is none.
  int line_of(const std::string& section, const std::string& name) const;
  [[noreturn]] void fail(const std::string& what, int line) const;

 private:
  struct Array {
    std::string type, format, text;  ///< the text is that of an array that is not appended
    std::size_t offset = 0;
    int line = 0;
  };

  void read_header(std::string_view header);
  const Array& find(const std::string& section, const std::string& name) const;
  std::string bytes(const Array& array) const;
  std::string decoded(std::string_view base64, const Array& array) const;
  std::string inflated(std::string_view data, const Array& array) const;
  int line_at(std::ptrdiff_t offset) const;
  template <class T>
  std::vector<T> numbers(const Array& array) const;

  std::filesystem::path path_;
  std::string text_;
  std::string_view data_;  ///< the appended part of it
  bool appended_is_raw_ = true, is_deflated_ = false;
  std::size_t header_size_ = 4;  ///< of a number in the headers of arrays, bytes
  std::size_t n_points_ = 0, n_cells_ = 0;
  std::map<std::string, int> section_lines_;
  std::map<std::string, std::map<std::string, Array>> arrays_;
};

}  // namespace polyfem
