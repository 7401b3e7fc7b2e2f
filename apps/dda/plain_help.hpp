/// \file The layout of --help.
#pragma once

#include <CLI/CLI.hpp>

#include <memory>
#include <string>

namespace dda {

/// Of a program or verb whose own verbs are called `verbs` ("VERB"): options with a word for their value, and
/// what else is to know of them in words behind their description.
std::shared_ptr<CLI::Formatter> plain_help(const std::string& verbs);

}  // namespace dda
