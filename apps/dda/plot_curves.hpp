/// \file Histories of results as curves.
#pragma once

#include "plot.hpp"

namespace dda {

/// The SVG file for `--history`, `--energy`, `--unbalanced`, `--bolts` and `--reactions`. Throws CallError
/// for a column or monitor that is not there and ddacontact::Error for files.
std::string curves_picture(const PlotArguments& arguments);

}  // namespace dda
