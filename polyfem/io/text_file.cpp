#include <polyfem/io/text_file.hpp>

#include <polyfem/core/error.hpp>

#include <cerrno>
#include <cstring>
#include <fstream>

namespace polyfem {

std::string read_text(const std::filesystem::path& path) {
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  std::string text;
  if (in && !error) {
    text.resize(size);
    in.read(text.data(), static_cast<std::streamsize>(size));
  }
  if (error || !in)
    throw FileError("cannot read \"" + path.string() +
                    "\": " + (error ? error.message() : std::strerror(errno)));
  return text;
}

}  // namespace polyfem
