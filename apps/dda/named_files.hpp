/// \file The files that a scene names, as far as its text tells.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dda {

/// Of a file.
std::string text_of(const std::filesystem::path& path);
/// Names between quotes in a text.
std::vector<std::string> quoted_words(const std::string& text);
/// Of those of the words that name files of the directory: blocks, boundaries, histories.
std::string texts_of_files(const std::filesystem::path& directory, const std::vector<std::string>& words);
/// A scene, and what files it or values of settings PATH=VALUE name.
std::vector<std::filesystem::path> files_of_scene(const std::filesystem::path& scene,
                                                  const std::vector<std::string>& settings);
/// Throws CallError where the results of a run in the directory would be written over one of the files.
void expect_none_overwritten(const std::filesystem::path& directory,
                             const std::vector<std::filesystem::path>& files);
/// Throws CallError where one of the files lies in the directory, with whose results it would be renamed.
void expect_none_in(const std::filesystem::path& directory, const std::vector<std::filesystem::path>& files);

}  // namespace dda
