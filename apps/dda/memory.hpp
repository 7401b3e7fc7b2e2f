/// \file The memory that there is, and whether a run fits into it.
#pragma once

#include <ddacontact/scene/scene.hpp>

#include <optional>
#include <string>

namespace dda {

/// Bytes that this program may still take: what the system has available, the limits of its control group and
/// of its address space, whichever is least; nothing where none of them is known.
std::optional<double> available_memory();

/// Bytes as "3.4 GB".
std::string bytes_text(double bytes);

/// Why a run of the scene does not fit, with what would; nothing when it fits.
std::optional<std::string> memory_problem(const ddacontact::Scene& scene);

}  // namespace dda
