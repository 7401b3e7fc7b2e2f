/// \file One scene in one size, stepped in one way, and the measuring of it.
#pragma once

#include <tests/performance/steps/measurement.hpp>

#include <string>
#include <vector>

namespace step_performance {

/// What to measure.
struct Case {
  std::string scene = "wall";
  int size = 1000;
  double time_step = 1e-2;             ///< s
  bool settled = false;                ///< from equilibrium instead of sudden gravity
  std::string method = "default";      ///< see Measurement
  std::vector<std::string> without{};  ///< skips switched off, by their names in scene files
  int threads = 1;
};

/// How thoroughly.
struct Effort {
  int warm_steps = 3, steps = 10;
  double seconds = 60;     ///< of the processor: no step is begun after these but the first measured one
  bool cholmod = true;     ///< measures CHOLMOD's own time too
  double factor_mb = 4e3;  ///< unless its factor is larger
};

/// Runs and measures in this process, whose memory is the case's own if it does nothing else. Throws
/// polyfem::Error for a scene or a skip that is not known.
Measurement measure(const Case& what, const Effort& effort);
/// What is known before anything is measured.
Measurement row_of(const Case& what);

}  // namespace step_performance
