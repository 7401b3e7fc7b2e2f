/// \file `dda view`: a web page with a whole run.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace dda {

/// Of a call of `dda view`.
struct ViewArguments {
  std::string directory, output;
};

/// Declares the verb.
void add_view(CLI::App& app, ViewArguments& call);

/// Writes the page. \return  an exit status
int view(const ViewArguments& call);

}  // namespace dda
