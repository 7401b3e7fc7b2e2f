/// \file `dda cut`: makes blocks simpler.
#pragma once

#include <ddacontact/scene/block_cutting.hpp>

#include <CLI/CLI.hpp>

#include <string>

namespace dda {

/// What the options of `dda cut` say.
struct CutArguments {
  std::string blocks, file;
  ddacontact::CutOptions options;
  double snap = 0;  ///< m; 0: none
};

/// Adds the verb with its options.
void add_cut(CLI::App& app, CutArguments& arguments);

/// Returns the exit status.
int cut(const CutArguments& arguments);

}  // namespace dda
