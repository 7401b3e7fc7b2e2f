/// \file `dda sweep`: runs a scene with many settings, some at a time.
#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dda {

/// What the options of `dda sweep` say.
struct SweepArguments {
  std::string scene, directory, table;
  std::vector<std::string> vary, outcomes, settings;
  std::string curve;                     ///< "X,Y": two columns of sweep.csv; empty: none
  std::string map;                       ///< "X,Y,VALUE": three columns; empty: none
  int jobs = 0;                          ///< processes at a time; 0: as many as processors
  int only = 0;                          ///< the one case to run; 0: all
  bool safety = false;                   ///< a search for the factor of safety each, instead of a run
  std::string range, tolerance, joints;  ///< of these searches, as `dda safety` has them; empty: left out
  bool slurm = false, quiet = false;

  /// Words that a case's `dda safety` is called with.
  std::vector<std::string> of_safety() const;
  /// The two columns of `curve`. Throws Error where it names no two.
  std::optional<std::pair<std::string, std::string>> curve_columns() const;
};

/// Adds the verb with its options.
void add_sweep(CLI::App& app, SweepArguments& arguments);

/// Returns the exit status.
int sweep(const SweepArguments& arguments);

}  // namespace dda
