/// \file The command line of `dda plot`.
#pragma once

#include "plot.hpp"

#include <CLI/CLI.hpp>

namespace dda {

/// Adds the verb "plot", which fills `arguments`.
void declare_plot(CLI::App& app, PlotArguments& arguments);

}  // namespace dda
