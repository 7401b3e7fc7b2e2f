#include <ddacontact/output/csv_file.hpp>

#include <ddacontact/output/output_error.hpp>
#include <polyfem/io/checksum.hpp>
#include <polyfem/io/write_error.hpp>

#include <charconv>

namespace ddacontact {

namespace {

/// The first bytes of a file; empty when there are not so many or they are not those of the mark.
std::string beginning(const std::filesystem::path& path, const FileMark& mark) {
  std::error_code error;
  if (std::filesystem::file_size(path, error) < mark.bytes || error) return "";
  std::string text(mark.bytes, 0);
  std::ifstream in(path, std::ios::binary);
  if (!in.read(text.data(), static_cast<std::streamsize>(text.size()))) return "";
  return polyfem::checksum(text) == mark.checksum ? text : "";
}

}  // namespace

CsvFile::CsvFile(const std::string& path, std::string_view header)
    : path_(path), file_(path, std::ios::binary) {
  line_ = header;
  write_line();
}

CsvFile::CsvFile(const std::string& path, std::string_view header, const std::filesystem::path& source,
                 const FileMark& mark)
    : path_(path) {
  const std::string kept = beginning(source, mark);
  goes_on_ = !kept.empty();
  if (!goes_on_) {
    *this = CsvFile(path, header);
    return;
  }
  std::error_code error;
  if (std::filesystem::equivalent(source, path, error)) {
    std::filesystem::resize_file(path, mark.bytes, error);
    if (error) throw OutputError("cannot write \"" + path_ + "\": " + error.message());
    file_.open(path, std::ios::binary | std::ios::app);
  } else {
    file_.open(path, std::ios::binary);
    file_ << kept;
  }
  mark_ = mark;
  if (!file_) throw polyfem::write_error(path_);
}

FileMark CsvFile::mark() {
  file_.flush();
  if (!file_) throw polyfem::write_error(path_);
  return mark_;
}

void CsvFile::separate() {
  if (!first_cell_) line_ += ',';
  first_cell_ = false;
}

void CsvFile::append(double value) {
  separate();
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value + 0.0, std::chars_format::general, 17).ptr;
  line_.append(text, end);
}

void CsvFile::append(const std::optional<double>& value) {
  if (value)
    append(*value);
  else
    append(std::string_view());
}

void CsvFile::append(long value) {
  separate();
  line_ += std::to_string(value);
}

void CsvFile::append(std::string_view text) {
  separate();
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    line_ += text;
    return;
  }
  line_ += '"';
  for (char c : text) {
    if (c == '"') line_ += '"';
    line_ += c;
  }
  line_ += '"';
}

void CsvFile::write_line() {
  line_ += '\n';
  mark_.bytes += line_.size();
  mark_.checksum = polyfem::checksum(line_, mark_.checksum);
  file_ << line_;
  if (!file_) throw polyfem::write_error(path_);
}

void CsvFile::close() {
  file_.close();
  if (!file_) throw polyfem::write_error(path_);
}

}  // namespace ddacontact
