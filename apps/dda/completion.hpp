/// \file Completion of words in a shell.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace dda {

/// A script for bash, and for zsh after `autoload -U bashcompinit; bashcompinit`: verbs, kinds, the options
/// of each, values that have a name, and topics of `dda help`. All else are files, which the shell completes
/// itself.
std::string completion_script(const CLI::App& app, const std::vector<std::string>& topics);

}  // namespace dda
