#include <ddacontact/output/frame_writer.hpp>

#include <ddacontact/output/frame_file.hpp>
#include <ddacontact/output/output_error.hpp>

#include <cstdio>
#include <string>

namespace ddacontact {

namespace {

constexpr char folder[] = "frames";

/// Relative to the result directory.
std::string file_name(const char* kind, int number) {
  char name[64];
  std::snprintf(name, sizeof name, "%s/%s_%06d.vtu", folder, kind, number);
  return name;
}

/// A name that `file_name` gives: kind_NUMBER.vtu.
bool is_ours(const std::filesystem::path& file) {
  const std::string stem = file.stem().string();
  const std::size_t number = stem.find('_') + 1;
  const std::string kind = stem.substr(0, number);
  return file.extension() == ".vtu" && (kind == "blocks_" || kind == "contacts_") &&
         stem.size() >= number + 6 && stem.find_first_not_of("0123456789", number) == std::string::npos;
}

/// Makes the folder, or leaves nothing of ours in it.
void clear(const std::filesystem::path& frames) {
  try {
    std::filesystem::create_directories(frames);
    for (const auto& entry : std::filesystem::directory_iterator(frames))
      if (is_ours(entry.path())) std::filesystem::remove(entry.path());
  } catch (const std::filesystem::filesystem_error& error) {
    throw OutputError("cannot clear \"" + frames.string() + "\": " + error.code().message());
  }
}

}  // namespace

FrameWriter::FrameWriter(const std::filesystem::path& directory, const FrameOptions& options)
    : directory_(directory),
      options_(options),
      results_(directory / "results.pvd"),
      contacts_(directory / "contacts.pvd") {
  clear(directory / folder);
}

void FrameWriter::write_step(const Stepper& stepper, const Labels& labels) {
  if (options_.every > 0 && stepper.counts().steps % options_.every == 0)
    write(capture_frame(stepper, labels, options_.fields()));
}

void FrameWriter::write_last(const Stepper& stepper, const Labels& labels) {
  if (last_time_ != stepper.state().time) write(capture_frame(stepper, labels, options_.fields()));
}

void FrameWriter::write(const Frame& frame) {
  const std::string blocks = file_name("blocks", n_frames_), contacts = file_name("contacts", n_frames_);
  write_blocks(directory_ / blocks, frame, options_);
  write_contacts(directory_ / contacts, frame);
  contacts_.add({frame.time, frame.step, contacts});
  results_.add({frame.time, frame.step, blocks});
  last_time_ = frame.time;
  ++n_frames_;
}

}  // namespace ddacontact
