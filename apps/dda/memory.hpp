/// \file Whether a run fits into the memory that there is.
#pragma once

#include <ddacontact/scene/scene.hpp>

#include <optional>
#include <string>

namespace dda {

/// Why a run of the scene does not fit, with what would; nothing when it fits.
std::optional<std::string> memory_problem(const ddacontact::Scene& scene);

}  // namespace dda
