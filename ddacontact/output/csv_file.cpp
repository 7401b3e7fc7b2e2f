#include <ddacontact/output/csv_file.hpp>

#include <ddacontact/output/output_error.hpp>

#include <charconv>

namespace ddacontact {

CsvFile::CsvFile(const std::string& path, std::string_view header)
    : path_(path), file_(path, std::ios::binary) {
  line_ = header;
  write_line();
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
  file_ << line_;
  if (!file_) throw OutputError("cannot write \"" + path_ + "\"");
}

void CsvFile::close() {
  file_.close();
  if (!file_) throw OutputError("cannot write \"" + path_ + "\"");
}

}  // namespace ddacontact
