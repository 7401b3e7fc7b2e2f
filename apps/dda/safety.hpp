/// \file `dda safety`: factor of safety by strength reduction.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace dda {

/// What the options of `dda safety` say.
struct SafetyArguments {
  std::string scene, directory;
  std::vector<std::string> settings;  ///< PATH=VALUE
  std::vector<std::string> joints;    ///< to be reduced; empty: all
  std::string range;                  ///< "A:B" or empty
  double tolerance = 0.005;           ///< of the factor
  int jobs = 0;                       ///< trials at a time; 0: as many as processors
  bool quiet = false, force = false;
};

/// Adds the verb with its options.
void add_safety(CLI::App& app, SafetyArguments& arguments);

/// Returns the exit status.
int safety(const SafetyArguments& arguments);

}  // namespace dda
