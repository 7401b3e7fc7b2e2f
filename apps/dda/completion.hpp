/// \file Completion of words in a shell.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace dda {

/// A script for bash, and for zsh after `autoload -U bashcompinit; bashcompinit`: verbs, the options of each,
/// and files.
std::string completion_script(const CLI::App& app);

}  // namespace dda
