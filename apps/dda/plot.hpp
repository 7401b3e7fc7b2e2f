/// \file `dda plot`: a picture of results, or of a scene before it is run.
#pragma once

#include <string>
#include <vector>

namespace dda {

struct PlotArguments {
  std::vector<std::string> directories;
  std::vector<std::string> fields, frames;  ///< empty: the usual one
  std::string output;
  bool reference = false, forces = false, crosses = false, thrust = false, names = false, own_range = false;
  bool numbers = false;               ///< of vertices and edges, in a scene
  std::vector<std::string> settings;  ///< PATH=VALUE of a scene
  std::string vectors;                ///< "displacement", "velocity" or empty
  std::string range;                  ///< "MIN,MAX" or empty
  std::string window;                 ///< "XMIN,XMAX,YMIN,YMAX" or empty
  double magnify = 1;                 ///< times the displacements
  double width = 0;                   ///< px; 0: the usual one
  std::vector<std::string> history;   ///< columns of monitors.csv
  std::vector<std::string> monitors;  ///< for `history`; empty: all
  bool energy = false, unbalanced = false;
  bool bolt_forces = false;  ///< of bolt_history.csv
  bool reactions = false;    ///< of support_history.csv

  bool has_curves() const { return energy || unbalanced || bolt_forces || reactions || !history.empty(); }
};

/// Returns the exit status.
int plot(const PlotArguments& arguments);

}  // namespace dda
