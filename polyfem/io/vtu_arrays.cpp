#include <polyfem/io/vtu_arrays.hpp>

#include <polyfem/core/error.hpp>
#include <polyfem/io/text_file.hpp>
#include <polyfem/io/zlib_blocks.hpp>

#include <pugixml.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>

namespace polyfem {
namespace {

constexpr std::string_view blanks = " \t\r\n";

/// The value of a base64 digit; -1 for other characters.
constexpr std::array<int, 256> base64_values = [] {
  std::array<int, 256> values{};
  values.fill(-1);
  int value = 0;
  for (const unsigned char digit : std::string_view("ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                                    "abcdefghijklmnopqrstuvwxyz0123456789+/"))
    values[digit] = value++;
  return values;
}();

/// The unsigned number of `size` bytes at `at`, little endian.
std::uint64_t header_number(std::string_view data, std::size_t at, std::size_t size) {
  std::uint64_t value = 0;
  std::memcpy(&value, data.data() + at, size);
  return value;
}

}  // namespace

VtuArrays::VtuArrays(const std::filesystem::path& path) : path_(path), text_(read_text(path)) {
  const std::size_t appended = text_.find("<AppendedData");
  std::string header = text_.substr(0, appended);
  if (appended != std::string::npos) {
    const std::size_t end = text_.find('>', appended), start = text_.find('_', appended);
    if (start == std::string::npos)
      fail("the appended data have no \"_\" before them: write the file again", line_at(appended));
    appended_is_raw_ = text_.substr(appended, end - appended).find("\"raw\"") != std::string::npos;
    data_ = std::string_view(text_).substr(start + 1);
    header += "</VTKFile>";
  }
  read_header(header);
}

void VtuArrays::read_header(std::string_view header) {
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_buffer(header.data(), header.size());
  if (!result)
    fail(std::string(result.description()) + ": the file is damaged; write it again", line_at(result.offset));
  const pugi::xml_node file = document.child("VTKFile");
  const int line = line_at(std::max<std::ptrdiff_t>(file.offset_debug(), 0));
  if (file.attribute("type").value() != std::string("UnstructuredGrid"))
    fail("it holds no unstructured grid: save the mesh as .vtu", line);
  if (file.attribute("byte_order").value() == std::string("BigEndian"))
    fail("its numbers are big endian: write it with byte_order=\"LittleEndian\"", line);
  const std::string compressor = file.attribute("compressor").value();
  is_deflated_ = compressor == "vtkZLibDataCompressor";
  if (!is_deflated_ && !compressor.empty())
    fail("compressor \"" + compressor + "\" is not read: write it with zlib, or without one", line);
  if (file.attribute("header_type").value() == std::string("UInt64")) header_size_ = 8;

  const pugi::xml_node grid = file.child("UnstructuredGrid"), piece = grid.child("Piece");
  if (!piece || piece.next_sibling("Piece"))
    fail("it should have one piece: merge the pieces of a parallel run first", line_at(grid.offset_debug()));
  n_points_ = piece.attribute("NumberOfPoints").as_ullong();
  n_cells_ = piece.attribute("NumberOfCells").as_ullong();
  const auto list = [&](const pugi::xml_node& section) {
    section_lines_[section.name()] = line_at(section.offset_debug());
    for (const pugi::xml_node& array : section.children("DataArray"))
      arrays_[section.name()][array.attribute("Name").value()] = {
          array.attribute("type").value(), array.attribute("format").value(), array.text().get(),
          static_cast<std::size_t>(array.attribute("offset").as_ullong()), line_at(array.offset_debug())};
  };
  list(grid.child("FieldData"));
  for (const char* const name : {"Points", "Cells", "PointData", "CellData"}) list(piece.child(name));
}

std::vector<std::string> VtuArrays::names(const std::string& section) const {
  std::vector<std::string> names;
  if (const auto found = arrays_.find(section); found != arrays_.end())
    for (const auto& [name, array] : found->second) names.push_back(name);
  return names;
}

const VtuArrays::Array& VtuArrays::find(const std::string& section, const std::string& name) const {
  const auto arrays = arrays_.find(section);
  if (arrays == arrays_.end() || !arrays->second.contains(name))
    fail("<" + section + "> has no array \"" + name + "\": write the file again, with the mesh",
         line_of(section, name));
  return arrays->second.at(name);
}

int VtuArrays::line_of(const std::string& section, const std::string& name) const {
  const auto arrays = arrays_.find(section);
  if (arrays != arrays_.end() && arrays->second.contains(name)) return arrays->second.at(name).line;
  const auto found = section_lines_.find(section);
  return found == section_lines_.end() ? 1 : found->second;
}

int VtuArrays::line_at(std::ptrdiff_t offset) const {
  return 1 + static_cast<int>(
                 std::count(text_.begin(), text_.begin() + std::max(offset, std::ptrdiff_t{0}), '\n'));
}

void VtuArrays::fail(const std::string& what, int line) const {
  throw FileError(path_.string() + ":" + std::to_string(line) + ": " + what);
}

std::vector<double> VtuArrays::reals(const std::string& section, const std::string& name) const {
  return numbers<double>(find(section, name));
}

std::vector<std::int64_t> VtuArrays::whole_numbers(const std::string& section,
                                                   const std::string& name) const {
  const Array& array = find(section, name);
  if (array.type.find("Int") == std::string::npos)
    fail("array \"" + name + "\" is of type " + array.type + ": it should be whole numbers", array.line);
  return numbers<std::int64_t>(array);
}

template <class T>
std::vector<T> VtuArrays::numbers(const Array& array) const {
  std::vector<T> result;
  if (array.format == "ascii") {
    const char* at = array.text.data();
    const char* const end = at + array.text.size();
    while ((at = std::find_if(at, end, [](char c) { return blanks.find(c) == blanks.npos; })) != end) {
      T value;
      const auto [next, error] = std::from_chars(at, end, value);
      if (error != std::errc())
        fail(
            "\"" +
                std::string(at, std::find_if(at, end, [](char c) { return blanks.find(c) != blanks.npos; })) +
                "\" is no number of type " + array.type,
            array.line);
      result.push_back(value);
      at = next;
    }
    return result;
  }
  const std::string raw = bytes(array);
  const auto convert = [&]<class Stored>(Stored) {
    result.resize(raw.size() / sizeof(Stored));
    for (std::size_t k = 0; k < result.size(); ++k) {
      Stored value;
      std::memcpy(&value, raw.data() + k * sizeof value, sizeof value);
      result[k] = static_cast<T>(value);
    }
    return raw.size() % sizeof(Stored) == 0;
  };
  const bool is_whole = array.type == "Float64"   ? convert(double{})
                        : array.type == "Float32" ? convert(float{})
                        : array.type == "Int64"   ? convert(std::int64_t{})
                        : array.type == "Int32"   ? convert(std::int32_t{})
                        : array.type == "Int16"   ? convert(std::int16_t{})
                        : array.type == "Int8"    ? convert(std::int8_t{})
                        : array.type == "UInt64"  ? convert(std::uint64_t{})
                        : array.type == "UInt32"  ? convert(std::uint32_t{})
                        : array.type == "UInt16"  ? convert(std::uint16_t{})
                        : array.type == "UInt8"   ? convert(std::uint8_t{})
                                                  : false;
  if (!is_whole)
    fail("an array of type \"" + array.type + "\" does not hold whole numbers of that type: write it again",
         array.line);
  return result;
}

std::string VtuArrays::bytes(const Array& array) const {
  const bool is_appended = array.format == "appended";
  if (!is_appended && array.format != "binary")
    fail("the format \"" + array.format + "\" is not one of ascii, binary and appended", array.line);
  if (is_appended && array.offset > data_.size())
    fail("the array lies beyond the end of the file: it is cut short; write it again", array.line);
  std::string_view data = is_appended ? data_.substr(array.offset) : std::string_view(array.text);
  std::string plain;
  if (!is_appended || !appended_is_raw_) {
    data.remove_prefix(std::min(data.find_first_not_of(blanks), data.size()));
    plain = decoded(data, array);
    if (is_deflated_ && plain.size() >= header_size_) {  // the header is padded, the blocks follow it
      const std::uint64_t n_header = (3 + header_number(plain, 0, header_size_)) * header_size_;
      const std::uint64_t n_digits = (n_header + 2) / 3 * 4;
      if (n_digits <= data.size())
        plain = decoded(data.substr(0, n_digits), array) + decoded(data.substr(n_digits), array);
    }
    data = plain;
  }
  if (is_deflated_) return inflated(data, array);
  if (data.size() < header_size_ || header_number(data, 0, header_size_) > data.size() - header_size_)
    fail("the array is shorter than it says: the file is cut short; write it again", array.line);
  return std::string(data.substr(header_size_, header_number(data, 0, header_size_)));
}

std::string VtuArrays::decoded(std::string_view base64, const Array& array) const {
  std::string result;
  unsigned bits = 0;
  int n_bits = 0;
  for (const char c : base64) {
    const int value = base64_values[static_cast<unsigned char>(c)];
    if (value < 0) {
      if (c == '=' || c == '<' || blanks.find(c) != blanks.npos) break;
      fail("'" + std::string(1, c) + "' is no digit of base64: the file is damaged; write it again",
           array.line);
    }
    bits = (bits << 6 | static_cast<unsigned>(value)) & 0xffffff;
    if ((n_bits += 6) >= 8) result += static_cast<char>(bits >> (n_bits -= 8) & 0xff);
  }
  return result;
}

std::string VtuArrays::inflated(std::string_view data, const Array& array) const {
  std::string wide;  // with a header of UInt64
  if (header_size_ == 4 && data.size() >= 4) {
    const std::uint64_t n_numbers = 3 + header_number(data, 0, 4);
    if (n_numbers <= data.size() / 4) {
      for (std::size_t k = 0; k < n_numbers; ++k) {
        const std::uint64_t number = header_number(data, 4 * k, 4);
        wide.append(reinterpret_cast<const char*>(&number), sizeof number);
      }
      data = wide.append(data.substr(4 * n_numbers));
    }
  }
  try {
    const std::vector<std::byte> bytes = inflate_blocks(data);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  } catch (const Error& error) {
    fail(std::string("an array cannot be inflated, ") + error.what() + ": write it again", array.line);
  }
}

}  // namespace polyfem
