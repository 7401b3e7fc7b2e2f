/// \file A result directory, opened.
#pragma once

#include <ddacontact/output/frame_reader.hpp>
#include <ddacontact/picture/bolt_layer.hpp>
#include <ddacontact/scene/scene.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dda {

/// Throws ddacontact::Error when `directory` is not one that a run made.
void expect_result_directory(const std::filesystem::path& directory);

/// The scene as run; nothing when its file is not there or is no longer understood.
std::optional<ddacontact::Scene> scene_of(const std::filesystem::path& directory);

/// The scene's title, else the directory's own name.
std::string title_of(const std::filesystem::path& directory, const std::optional<ddacontact::Scene>& scene);

/// The directory's own name, also of "." and "a/".
std::string name_of(const std::filesystem::path& directory);

/// What each block of the frames is called, those that a stage has taken out too. Without the scene: those of
/// blocks.csv, which has no rows of these; nothing when that is not there either.
std::vector<std::string> block_names(const std::filesystem::path& directory);

/// The bolts at the end of the run; nothing when it has none.
std::vector<ddacontact::BoltLine> bolts_of(const std::filesystem::path& directory);

/// The water at the end of a step: that of the stage which made it.
ddacontact::Water water_at(const std::filesystem::path& directory, const ddacontact::Scene& scene, long step);

/// The frame of `--frame WORD`: the number of a step, or "last". Throws CallError that lists what is there.
const ddacontact::FrameFile& frame_of(const ddacontact::FrameSeries& series, const std::string& word,
                                      const std::filesystem::path& directory);

/// "0 to 300, every 10", or a list: the steps of a series.
std::string steps_text(const ddacontact::FrameSeries& series);

}  // namespace dda
