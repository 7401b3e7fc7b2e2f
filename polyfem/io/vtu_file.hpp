/// \file Points, cells and values on them as a file of VTK: an UnstructuredGrid, .vtu.
#pragma once

#include <polyfem/io/zlib_blocks.hpp>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace polyfem {

/// Numbers of VTK for kinds of cells.
enum class VtkCell : std::uint8_t { vertex = 1, triangle = 5, polygon = 7 };

/// Where a named array of a .vtu file belongs.
enum class VtuSection { field_data, point_data, cell_data };

/// A file in the making. Arrays are deflated as they are added, so the caller's can go; their names need no
/// quoting in XML. Little endian, appended raw, zlib: read by VTK, ParaView and meshio.
class VtuFile {
 public:
  /// The file's bytes are the same for any number of threads.
  explicit VtuFile(int n_threads = 1) : deflater_(n_threads) {}

  /// \param[in] coordinates  x, y, z of each point
  void set_points(std::span<const double> coordinates);
  /// \param[in] connectivity  the points of each cell, one cell after another
  /// \param[in] offsets       where each cell ends in `connectivity`
  void set_cells(std::span<const std::int64_t> connectivity, std::span<const std::int64_t> offsets,
                 std::span<const VtkCell> types);
  /// \param[in] values  `n_components` of each point or cell, one after another; in field data, of each tuple
  void add(VtuSection section, std::string_view name, std::span<const double> values, int n_components = 1) {
    append(section, name, values, n_components);
  }
  void add(VtuSection section, std::string_view name, std::span<const std::int32_t> values,
           int n_components = 1) {
    append(section, name, values, n_components);
  }
  void add(VtuSection section, std::string_view name, std::span<const std::int64_t> values,
           int n_components = 1) {
    append(section, name, values, n_components);
  }
  void add(VtuSection section, std::string_view name, std::span<const std::uint8_t> values,
           int n_components = 1) {
    append(section, name, values, n_components);
  }

  /// Throws FileError; what was written is then removed.
  void write(const std::filesystem::path& path) const;

 private:
  template <class T>
  void append(VtuSection section, std::string_view name, std::span<const T> values, int n_components);
  template <class T>
  void append(std::string& elements, std::string_view name, std::span<const T> values, int n_components,
              bool says_count = false);

  std::string points_, cells_, field_data_, point_data_, cell_data_;  ///< the XML elements of arrays
  std::size_t n_points_ = 0, n_cells_ = 0;
  std::vector<std::string> data_;  ///< of each array, deflated
  std::size_t data_size_ = 0;
  BlockDeflater deflater_;
};

}  // namespace polyfem
