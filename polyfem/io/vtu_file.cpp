#include <polyfem/io/vtu_file.hpp>

#include <polyfem/core/error.hpp>
#include <polyfem/io/vtu_types.hpp>
#include <polyfem/io/write_error.hpp>

#include <fstream>

namespace polyfem {
namespace {

std::string attribute(std::string_view name, std::string_view value) {
  return " " + std::string(name) + "=\"" + std::string(value) + "\"";
}
std::string attribute(std::string_view name, std::size_t value) {
  return attribute(name, std::to_string(value));
}

void write_section(std::ostream& out, std::string_view tag, const std::string& elements) {
  out << "<" << tag << ">\n" << elements << "</" << tag << ">\n";
}

}  // namespace

template <class T>
void VtuFile::append(std::string& elements, std::string_view name, std::span<const T> values,
                     int n_components, bool says_count) {
  const std::size_t components = static_cast<std::size_t>(n_components);
  elements += "<DataArray" + attribute("type", vtk_type<T>) + attribute("Name", name) +
              attribute("NumberOfComponents", components);
  if (says_count) elements += attribute("NumberOfTuples", values.size() / components);
  elements += attribute("format", "appended") + attribute("offset", data_size_) + "/>\n";
  data_.push_back(deflater_.deflate(std::as_bytes(values)));
  data_size_ += data_.back().size();
}

void VtuFile::set_points(std::span<const double> coordinates) {
  n_points_ = coordinates.size() / 3;
  append(points_, "Points", coordinates, 3);
}

void VtuFile::set_cells(std::span<const std::int64_t> connectivity, std::span<const std::int64_t> offsets,
                        std::span<const VtkCell> types) {
  n_cells_ = types.size();
  append(cells_, "connectivity", connectivity, 1);
  append(cells_, "offsets", offsets, 1);
  append(cells_, "types",
         std::span<const std::uint8_t>(reinterpret_cast<const std::uint8_t*>(types.data()), types.size()), 1);
}

template <class T>
void VtuFile::append(VtuSection section, std::string_view name, std::span<const T> values, int n_components) {
  const bool in_field_data = section == VtuSection::field_data;
  std::string& elements = in_field_data                       ? field_data_
                          : section == VtuSection::point_data ? point_data_
                                                              : cell_data_;
  append(elements, name, values, n_components, in_field_data);
}

template void VtuFile::append(VtuSection, std::string_view, std::span<const double>, int);
template void VtuFile::append(VtuSection, std::string_view, std::span<const std::int32_t>, int);
template void VtuFile::append(VtuSection, std::string_view, std::span<const std::int64_t>, int);
template void VtuFile::append(VtuSection, std::string_view, std::span<const std::uint8_t>, int);

void VtuFile::write(const std::filesystem::path& path) const {
  std::ofstream out(path, std::ios::binary);
  if (!out) throw write_error(path);
  out << "<?xml version=\"1.0\"?>\n<VTKFile"
      << attribute("type", "UnstructuredGrid") + attribute("version", "1.0") +
             attribute("byte_order", "LittleEndian") + attribute("header_type", "UInt64") +
             attribute("compressor", "vtkZLibDataCompressor")
      << ">\n<UnstructuredGrid>\n";
  write_section(out, "FieldData", field_data_);
  out << "<Piece" << attribute("NumberOfPoints", n_points_) + attribute("NumberOfCells", n_cells_) << ">\n";
  write_section(out, "PointData", point_data_);
  write_section(out, "CellData", cell_data_);
  write_section(out, "Points", points_);
  write_section(out, "Cells", cells_);
  out << "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  for (const std::string& array : data_) out << array;
  out << "\n</AppendedData>\n</VTKFile>\n";
  out.close();
  if (out) return;
  const FileError error = write_error(path);
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored)) std::filesystem::remove(path, ignored);
  throw error;
}

}  // namespace polyfem
