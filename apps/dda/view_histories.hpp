/// \file Curves and verdict of a result directory, for its page.
#pragma once

#include <ddacontact/page/page_data.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace dda {

/// Displacements and velocities of monitors and the energies; none where their files are not there.
std::vector<ddacontact::PageHistory> histories_of(const std::filesystem::path& directory);

/// How the run ended, in lines; none without summary.json.
std::vector<std::string> verdict_of(const std::filesystem::path& directory);

}  // namespace dda
