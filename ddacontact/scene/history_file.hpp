/// \file Histories of supports, loads and the ground from files of comma-separated values.
///
/// The first line names the columns, each with its unit in brackets where it is not SI: `t,ax [g]`, or
/// `t [ms],ax [cm/s2],ay [cm/s2]`. The first column is the time; names that end in x or y say which component
/// a column is, others follow in that order. Lines that begin with # are comments.
#pragma once

#include <ddacontact/scene/records.hpp>

#include <filesystem>

namespace ddacontact::scene_format {

/// Puts the entries of the files that histories name into them. False when a file cannot be read.
bool read_histories(const std::filesystem::path& directory, Document& document, ProblemList& problems);

}  // namespace ddacontact::scene_format
