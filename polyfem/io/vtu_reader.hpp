/// \file Reads .vtu files of the form VtuFile writes.
#pragma once

#include <polyfem/io/vtu_file.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace polyfem {

/// A file in memory; arrays are inflated when they are requested. Everything throws FileError, which names
/// the file, when it is missing, damaged or of another form.
class VtuReader {
 public:
  explicit VtuReader(const std::filesystem::path& path);

  std::size_t n_points() const { return n_points_; }
  std::size_t n_cells() const { return n_cells_; }

  bool has(VtuSection section, const std::string& name) const;
  /// x, y, z of each point.
  std::vector<double> points() const;
  /// The values of an array, which must be of this type and number of components; of every point or cell.
  template <class T>
  std::vector<T> read(VtuSection section, const std::string& name, int n_components = 1) const;
  /// Throws FileError about this file.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  struct Array {
    std::string type, n_components;
    std::size_t offset = 0;
  };
  using Arrays = std::map<std::string, Array>;

  void read_header(std::string_view header);
  const Arrays& arrays(VtuSection section) const;
  template <class T>
  std::vector<T> values(const Arrays& among, const std::string& name, int n_components) const;

  std::filesystem::path path_;
  std::string text_;
  std::string_view data_;  ///< the appended part of it
  std::size_t n_points_ = 0, n_cells_ = 0;
  Arrays points_, field_data_, point_data_, cell_data_;
};

}  // namespace polyfem
