#include <ddacontact/output/frame_writer.hpp>

#include <ddacontact/output/frame_file.hpp>
#include <ddacontact/output/output_error.hpp>

#include <cstdio>
#include <set>
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

/// Runs `work` on the folder of a directory, with its errors in our words.
template <class Work>
void change_folder(const std::filesystem::path& directory, const Work& work) {
  const std::filesystem::path frames = directory / folder;
  try {
    std::filesystem::create_directories(frames);
    work(frames);
  } catch (const std::filesystem::filesystem_error& error) {
    throw OutputError("cannot clear \"" + frames.string() + "\": " + error.code().message());
  }
}

/// Leaves nothing of ours but what the series list.
void clear(const std::filesystem::path& frames, const std::set<std::string>& listed) {
  for (const auto& entry : std::filesystem::directory_iterator(frames))
    if (is_ours(entry.path()) && !listed.contains(entry.path().filename().string()))
      std::filesystem::remove(entry.path());
}

}  // namespace

FrameWriter::FrameWriter(const std::filesystem::path& directory, const FrameOptions& options)
    : FrameWriter(directory, options, directory, Series{}) {}

FrameWriter::FrameWriter(const std::filesystem::path& directory, const FrameOptions& options,
                         const std::filesystem::path& source, int n_frames)
    : FrameWriter(directory, options, source, read_series(source, n_frames)) {
  goes_on_ = n_frames_ == n_frames;
}

/// The first n_frames of both series, when they are there with their files; else none.
FrameWriter::Series FrameWriter::read_series(const std::filesystem::path& source, int n_frames) {
  try {
    Series series{polyfem::read_pvd(source / "results.pvd"), polyfem::read_pvd(source / "contacts.pvd")};
    for (std::vector<polyfem::PvdEntry>* entries : {&series.blocks, &series.contacts}) {
      if (entries->size() < static_cast<std::size_t>(n_frames)) return {};
      entries->resize(static_cast<std::size_t>(n_frames));
      for (const polyfem::PvdEntry& entry : *entries)
        if (!std::filesystem::exists(source / entry.file)) return {};
    }
    return series;
  } catch (const polyfem::FileError&) {
    return {};
  }
}

FrameWriter::FrameWriter(const std::filesystem::path& directory, const FrameOptions& options,
                         const std::filesystem::path& source, Series series)
    : directory_(directory),
      options_(options),
      results_(directory / "results.pvd", series.blocks),
      contacts_(directory / "contacts.pvd", series.contacts),
      n_frames_(static_cast<int>(series.blocks.size())) {
  if (n_frames_ > 0) last_time_ = series.blocks.back().time;
  std::set<std::string> listed;
  for (const std::vector<polyfem::PvdEntry>* entries : {&series.blocks, &series.contacts})
    for (const polyfem::PvdEntry& entry : *entries)
      listed.insert(std::filesystem::path(entry.file).filename().string());
  change_folder(directory, [&](const std::filesystem::path& frames) {
    clear(frames, listed);
    if (std::filesystem::equivalent(source, directory)) return;
    for (const std::string& file : listed)
      std::filesystem::copy_file(source / folder / file, frames / file,
                                 std::filesystem::copy_options::overwrite_existing);
  });
}

void FrameWriter::write_step(const Stepper& stepper, const Labels& labels) {
  if (!options_.skip) (void)capture_frame(stepper, labels, {});
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
