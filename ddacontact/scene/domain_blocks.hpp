/// \file The blocks of [domain].
#pragma once

#include <ddacontact/scene/records.hpp>

#include <filesystem>

namespace ddacontact::scene_format {

/// Origin of the blocks of a domain, in messages.
inline constexpr const char* domain_origin = "the domain";

/// Cuts the domain of a document and appends its blocks, called d0, d1, ...; `directory` is the scene's.
/// Returns whether the drawing that the domain names could be read.
bool add_domain(const std::filesystem::path& directory, Document& document, ProblemList& problems);

}  // namespace ddacontact::scene_format
