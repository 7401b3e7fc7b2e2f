#include <ddacontact/output/checkpoint.hpp>

#include <ddacontact/core/bytes.hpp>
#include <ddacontact/output/output_error.hpp>
#include <polyfem/io/checksum.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

namespace ddacontact {

namespace {

constexpr std::string_view magic = "polydda checkpoint ";
/// Of the layout below; to be raised with every change of what a checkpoint holds or of how steps are made.
constexpr std::uint32_t version = 21;
constexpr std::uint64_t byte_order = 0x0102030405060708;

/// What stands before the contents.
struct Head {
  std::uint32_t version = ddacontact::version;
  std::uint64_t byte_order = ddacontact::byte_order;
  std::uint64_t size = 0;
  std::uint32_t checksum = 0;
};
constexpr std::size_t head_size = magic.size() + 4 + 8 + 8 + 4;

template <class Archive, class SomeHead>
void visit_head(Archive& visit, SomeHead& head) {
  visit(head.version);
  visit(head.byte_order);
  visit(head.size);
  visit(head.checksum);
}

template <class Archive, class SomeCheckpoint>
void visit_contents(
    Archive& visit, SomeCheckpoint& c,
    std::conditional_t<std::is_const_v<SomeCheckpoint>, const std::string, std::string>& record) {
  visit(c.scene);
  visit.list(c.stage_steps, [&](auto& steps) { visit(steps); });
  visit(c.made_by);
  for (auto* mark : {&c.marks.monitors, &c.marks.energy, &c.marks.bolts, &c.marks.supports}) {
    visit(mark->bytes);
    visit(mark->checksum);
  }
  visit(c.marks.n_frames);
  visit(record);
}

[[noreturn]] void fail(const char* action, const std::filesystem::path& path, int error) {
  throw OutputError(std::string("cannot ") + action + " \"" + path.string() +
                    "\": " + std::generic_category().message(error));
}

/// A file that is written anew; gone unless it is kept.
class NewFile {
 public:
  explicit NewFile(std::filesystem::path path)
      : path_(std::move(path)),
        descriptor_(open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
    if (descriptor_ < 0) fail("write", path_, errno);
  }
  ~NewFile() {
    if (descriptor_ < 0) return;
    close(descriptor_);
    unlink(path_.c_str());
  }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail("write", path_, errno);
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }
  /// Puts it on the disk, then in the place of another.
  void replace(const std::filesystem::path& other) {
    if (fsync(descriptor_) != 0 || rename(path_.c_str(), other.c_str()) != 0) fail("write", other, errno);
    close(std::exchange(descriptor_, -1));
  }

 private:
  std::filesystem::path path_;
  int descriptor_;
};

/// That a file was renamed is itself something to put on the disk.
void sync_directory(const std::filesystem::path& directory) {
  const int descriptor =
      open(directory.empty() ? "." : directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint) {
  ByteWriter contents, head;
  visit_contents(contents, checkpoint, to_bytes(checkpoint.record));
  const Head of_contents{.size = contents.bytes.size(), .checksum = polyfem::checksum(contents.bytes)};
  visit_head(head, of_contents);
  std::filesystem::path part = path;
  NewFile file(part += ".part");
  file.write(magic);
  file.write(head.bytes);
  file.write(contents.bytes);
  file.replace(path);
  sync_directory(path.parent_path());
}

Checkpoint read_checkpoint(const std::filesystem::path& path) {
  const std::string name = "\"" + path.string() + "\"";
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path)) throw OutputError("cannot read " + name);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (bytes.size() < head_size || !bytes.starts_with(magic))
    throw OutputError(name +
                      " is not a checkpoint (one is written as checkpoint.bin into every result directory)");
  Head head;
  ByteReader reader(std::string_view(bytes).substr(magic.size()));
  visit_head(reader, head);
  if (head.byte_order != byte_order)
    throw OutputError(name + " was written on another kind of machine (run the scene anew)");
  if (head.version != version)
    throw OutputError(name + " has version " + std::to_string(head.version) + " of the format, not " +
                      std::to_string(version) +
                      " (resume with the program that wrote it, or run the scene anew)");
  const std::string_view contents = std::string_view(bytes).substr(head_size);
  if (contents.size() != head.size || polyfem::checksum(contents) != head.checksum)
    throw OutputError(name + " is damaged (take an older one, or run the scene anew)");
  Checkpoint checkpoint;
  std::string record;
  ByteReader of_contents(contents);
  visit_contents(of_contents, checkpoint, record);
  of_contents.expect_end();
  checkpoint.record = run_record_from(record);
  return checkpoint;
}

}  // namespace ddacontact
