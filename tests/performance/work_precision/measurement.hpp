/// \file What one solution of a problem costs and how good it is.
#pragma once

#include <tests/performance/work_precision/problem.hpp>

#include <polyfem/mesh/polygon_mesh.hpp>

#include <chrono>
#include <limits>
#include <map>
#include <string>

namespace work_precision {

/// Wall seconds of the stages.
struct Stages {
  double mesh = 0;     ///< not part of the total
  double pattern = 0;  ///< numbering of unknowns, boundary conditions, places of the entries
  double assembly = 0;
  double factorization = 0;  ///< with its analysis; for an iterative solver its preconditioner
  double solve = 0;
  double total() const { return pattern + assembly + factorization + solve; }
};

/// Relative errors; of a problem without a solution the error of the watched displacement and that of the
/// energy norm follow from the two values.
struct Accuracy {
  int n_unknowns = 0;  ///< held ones included
  double l2 = std::numeric_limits<double>::quiet_NaN(), energy = l2;
  double watched = 0;  ///< displacement
  double work = 0;     ///< of the loads: f . u
};

/// The same discretization solved in several ways.
struct Run {
  Accuracy accuracy;
  std::map<std::string, Stages> stages;  ///< by solver
};

/// Seconds since the last call.
class StopWatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace work_precision
