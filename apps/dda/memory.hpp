/// \file The memory of a run: whether it fits, what it was at most, what becomes of what a step frees.
#pragma once

#include <ddacontact/scene/scene.hpp>

#include <optional>
#include <string>

namespace dda {

/// Why a run of the scene does not fit, with what would; nothing when it fits.
std::optional<std::string> memory_problem(const ddacontact::Scene& scene);

/// A step frees what it took, and the next one takes as much again: the process keeps it.
void keep_freed_memory();

/// What the process had at most, MB.
double peak_memory_mb();

}  // namespace dda
