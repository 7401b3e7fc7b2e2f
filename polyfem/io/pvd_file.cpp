#include <polyfem/io/pvd_file.hpp>

#include <polyfem/core/error.hpp>
#include <polyfem/io/text_file.hpp>
#include <polyfem/io/write_error.hpp>

#include <pugixml.hpp>

#include <cerrno>
#include <charconv>

namespace polyfem {
namespace {

constexpr char head[] =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
    "<Collection>\n";
constexpr char tail[] = "</Collection>\n</VTKFile>\n";

template <class T>
std::string text_of(T number) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, number).ptr};
}

template <class T>
T number_in(const pugi::xml_node& node, const char* attribute, const std::filesystem::path& path) {
  const std::string_view text = node.attribute(attribute).value();
  T number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size())
    throw FileError("\"" + path.string() + "\" is damaged: an entry has no valid \"" + attribute + "\"");
  return number;
}

std::string line_of(const PvdEntry& entry) {
  return "<DataSet timestep=\"" + text_of(entry.time) + "\" step=\"" + text_of(entry.step) +
         "\" part=\"0\" file=\"" + entry.file + "\"/>\n";
}

}  // namespace

PvdFile::PvdFile(const std::filesystem::path& path, const std::vector<PvdEntry>& entries) : path_(path) {
  std::filesystem::path part = path;
  part += ".part";
  std::ofstream whole(part, std::ios::binary);
  whole << head;
  for (const PvdEntry& entry : entries) whole << line_of(entry);
  end_ = whole.tellp();
  whole << tail;
  whole.close();
  std::error_code error;
  if (whole) std::filesystem::rename(part, path, error);
  if (whole && !error) out_.open(path, std::ios::binary | std::ios::in | std::ios::out);
  if (whole && !error && out_) return;
  if (error) errno = error.value();
  const FileError reason = write_error(path_);
  std::filesystem::remove(part, error);
  throw reason;
}

void PvdFile::add(const PvdEntry& entry) {
  const std::string line = line_of(entry);
  out_.seekp(end_);
  out_ << line + tail << std::flush;
  if (!out_) {
    const FileError reason = write_error(path_);
    restore_end();
    throw reason;
  }
  end_ += static_cast<std::streamoff>(line.size());
}

void PvdFile::restore_end() {
  out_.close();  // drops what was not written
  out_.clear();
  out_.open(path_, std::ios::binary | std::ios::in | std::ios::out);
  out_.seekp(end_);
  out_ << tail << std::flush;
  std::error_code ignored;
  std::filesystem::resize_file(path_, static_cast<std::uintmax_t>(end_) + sizeof tail - 1, ignored);
}

std::vector<PvdEntry> read_pvd(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  pugi::xml_document document;
  if (const pugi::xml_parse_result result = document.load_buffer(text.data(), text.size()); !result)
    throw FileError("\"" + path.string() + "\" is damaged: " + result.description());
  const pugi::xml_node collection = document.child("VTKFile").child("Collection");
  if (!collection) throw FileError("\"" + path.string() + "\" is not a series of files (no <Collection>)");
  std::vector<PvdEntry> entries;
  for (const pugi::xml_node& node : collection.children("DataSet"))
    entries.push_back({number_in<double>(node, "timestep", path), number_in<long>(node, "step", path),
                       node.attribute("file").value()});
  return entries;
}

}  // namespace polyfem
