/// \file `dda help TOPIC` and `dda schema`.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace dda {

/// Below the verbs in `dda --help`: examples, exit statuses, where to read on.
std::string help_footer();

/// Prints a topic, or for "" the list of topics. `app` is what the topic "completion" describes. Returns the
/// exit status; an unknown topic is an error that names the nearest.
int help(const CLI::App& app, const std::string& topic);

/// Prints the JSON schema of the scene format.
int schema();

}  // namespace dda
