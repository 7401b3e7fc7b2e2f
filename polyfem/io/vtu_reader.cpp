#include <polyfem/io/vtu_reader.hpp>

#include <polyfem/core/error.hpp>
#include <polyfem/io/text_file.hpp>
#include <polyfem/io/vtu_types.hpp>

#include <pugixml.hpp>

#include <cstring>

namespace polyfem {

VtuReader::VtuReader(const std::filesystem::path& path) : path_(path), text_(read_text(path)) {
  const std::size_t appended = text_.find("<AppendedData encoding=\"raw\">");
  const std::size_t data = appended == std::string::npos ? appended : text_.find('_', appended);
  if (data == std::string::npos) fail("it has no appended raw data");
  data_ = std::string_view(text_).substr(data + 1);
  read_header(std::string_view(text_).substr(0, appended));
}

void VtuReader::read_header(std::string_view header) {
  const std::string xml = std::string(header) + "</VTKFile>";
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_buffer(xml.data(), xml.size());
  if (!result) fail(result.description());
  const pugi::xml_node file = document.child("VTKFile");
  const auto says = [&](const char* attribute, std::string_view value) {
    return file.attribute(attribute).value() == value;
  };
  if (!says("byte_order", "LittleEndian") || !says("header_type", "UInt64") ||
      !says("compressor", "vtkZLibDataCompressor"))
    fail("its data are not little endian, zlib, with headers of UInt64");
  const pugi::xml_node grid = file.child("UnstructuredGrid"), piece = grid.child("Piece");
  if (!piece) fail("it has no unstructured grid");
  n_points_ = piece.attribute("NumberOfPoints").as_ullong();
  n_cells_ = piece.attribute("NumberOfCells").as_ullong();

  const auto list = [](const pugi::xml_node& section, Arrays& arrays) {
    for (const pugi::xml_node& array : section.children("DataArray"))
      arrays[array.attribute("Name").value()] = {array.attribute("type").value(),
                                                 array.attribute("NumberOfComponents").value(),
                                                 array.attribute("offset").as_ullong()};
  };
  list(grid.child("FieldData"), field_data_);
  list(piece.child("PointData"), point_data_);
  list(piece.child("CellData"), cell_data_);
  list(piece.child("Points"), points_);
}

const VtuReader::Arrays& VtuReader::arrays(VtuSection section) const {
  switch (section) {
    case VtuSection::field_data:
      return field_data_;
    case VtuSection::point_data:
      return point_data_;
    case VtuSection::cell_data:
      break;
  }
  return cell_data_;
}

bool VtuReader::has(VtuSection section, const std::string& name) const {
  return arrays(section).contains(name);
}

std::vector<double> VtuReader::points() const {
  std::vector<double> coordinates = values<double>(points_, "Points", 3);
  if (coordinates.size() / 3 != n_points_) fail("its number of points is not what it says");
  return coordinates;
}

template <class T>
std::vector<T> VtuReader::read(VtuSection section, const std::string& name, int n_components) const {
  std::vector<T> result = values<T>(arrays(section), name, n_components);
  const std::size_t n_tuples = result.size() / static_cast<std::size_t>(n_components);
  if ((section == VtuSection::point_data && n_tuples != n_points_) ||
      (section == VtuSection::cell_data && n_tuples != n_cells_))
    fail("array \"" + name + "\" is not of the length the file says");
  return result;
}

template std::vector<double> VtuReader::read(VtuSection, const std::string&, int) const;
template std::vector<std::int32_t> VtuReader::read(VtuSection, const std::string&, int) const;
template std::vector<std::int64_t> VtuReader::read(VtuSection, const std::string&, int) const;
template std::vector<std::uint8_t> VtuReader::read(VtuSection, const std::string&, int) const;

template <class T>
std::vector<T> VtuReader::values(const Arrays& among, const std::string& name, int n_components) const {
  const auto found = among.find(name);
  if (found == among.end()) fail("it has no array \"" + name + "\"");
  const Array& array = found->second;
  if (array.type != vtk_type<T> || array.n_components != std::to_string(n_components))
    fail("array \"" + name + "\" is not of type " + vtk_type<T> + " with " + std::to_string(n_components) +
         " components");
  if (array.offset > data_.size()) fail("array \"" + name + "\": it lies beyond the end of the file");
  std::vector<std::byte> bytes;
  try {
    bytes = inflate_blocks(data_.substr(array.offset));
  } catch (const Error& error) {
    fail("array \"" + name + "\": " + error.what());
  }
  if (bytes.size() % (sizeof(T) * static_cast<std::size_t>(n_components)) != 0)
    fail("array \"" + name + "\" does not end with a whole tuple");
  std::vector<T> result(bytes.size() / sizeof(T));
  if (!bytes.empty()) std::memcpy(result.data(), bytes.data(), bytes.size());
  return result;
}

void VtuReader::fail(const std::string& what) const {
  throw FileError("cannot read \"" + path_.string() + "\": " + what);
}

}  // namespace polyfem
