#include <ddacontact/output/whole_file.hpp>

#include <ddacontact/output/older_results.hpp>
#include <polyfem/io/write_error.hpp>

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <fstream>

namespace ddacontact {

namespace fs = std::filesystem;

namespace {

/// Where a symbolic link points to.
fs::path target_of(const fs::path& path) {
  std::error_code error;
  fs::path target = fs::is_symlink(path, error) ? fs::weakly_canonical(path, error) : path;
  return error ? path : target;
}

/// Of a new file beside it; runs at the same time have names of their own.
fs::path part_of(const fs::path& path) {
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_regular_file(path, error)) return path;
  fs::path part = path;
  return part += ".part" + std::to_string(::getpid());
}

class WholeFile {
 public:
  explicit WholeFile(const fs::path& path) : shown_(path), path_(target_of(path)), part_(part_of(path_)) {}
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;
  /// Removes what is not complete.
  ~WholeFile() {
    std::error_code ignored;
    if (part_ != path_) fs::remove(part_, ignored);
  }

  /// Where a symbolic link points to.
  const fs::path& path() const { return path_; }
  void write(const std::function<void(std::ostream&)>& write_to) const {
    errno = 0;
    std::ofstream out(part_, std::ios::binary);
    if (out) write_to(out);
    out.close();
    if (!out) throw polyfem::write_error(shown_);
  }
  /// Gives the complete file its name.
  void finish() const {
    if (part_ != path_ && std::rename(part_.c_str(), path_.c_str()) != 0) throw polyfem::write_error(shown_);
  }

 private:
  fs::path shown_, path_, part_;
};

}  // namespace

void write_whole(const fs::path& path, const std::function<void(std::ostream&)>& write_to) {
  const WholeFile file(path);
  file.write(write_to);
  file.finish();
}

std::optional<fs::path> write_and_keep_older(const fs::path& path, std::string_view text) {
  const WholeFile file(path);
  file.write([&](std::ostream& out) { out << text; });
  std::optional<fs::path> kept = keep_older_file(file.path(), text);
  file.finish();
  return kept;
}

}  // namespace ddacontact
