#include <ddacontact/scene/file_text.hpp>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

namespace ddacontact::scene_format {

FileText read_text(const std::string& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file) text << file.rdbuf();
  // An empty file sets failbit on `text`: nothing was inserted.
  const bool unreadable = !file.is_open() || file.bad() || (text.fail() && errno != 0);
  if (unreadable) return {std::nullopt, std::strerror(errno != 0 ? errno : EIO)};
  return {std::move(text).str(), ""};
}

}  // namespace ddacontact::scene_format
