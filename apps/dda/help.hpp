/// \file `dda help` and `dda schema`.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace dda {

/// Below the verbs in `dda --help`: examples, exit statuses, where to read on.
std::string help_footer();

/// Prints a topic, the help of a verb of `app` ("run") or of its kind ("make wall"), or without words the
/// list of topics. Returns the exit status; an unknown word is an error that names the nearest.
int help(const CLI::App& app, const std::vector<std::string>& words);

/// Prints the JSON schema of the scene format.
int schema();

}  // namespace dda
