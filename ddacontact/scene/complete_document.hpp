/// \file What a document only names or stands for, put in its place.
#pragma once

#include <ddacontact/scene/records.hpp>

#include <filesystem>

namespace ddacontact::scene_format {

/// Adds the blocks of the geometry file, of [domain] and of grids, makes rounded coordinates touch, gives
/// blocks their initial stress and replaces selectors by what they find; `directory` is the scene's. Returns
/// whether all files that the document names could be read.
bool complete_document(const std::filesystem::path& directory, Document& document, ProblemList& problems);

}  // namespace ddacontact::scene_format
