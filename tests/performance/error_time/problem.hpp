/// \file What is analysed, and how wrong the answer is.
#pragma once

#include <tests/performance/error_time/method.hpp>

#include <ddacontact/time/stepper.hpp>

#include <functional>

namespace error_time {

/// A number that a user wants from an analysis.
struct Quantity {
  std::string name;         ///< of files
  std::string description;  ///< "error of the way after one second"
};

/// The relative errors of a problem's quantities at the end of a run.
using Judge = std::function<std::vector<double>(const ddacontact::Stepper&)>;

/// An analysis that can be made at several costs.
struct Problem {
  std::string name, title, description;
  std::vector<Quantity> quantities;
  std::string setting;           ///< what `settings` are: "Δt, s"
  std::vector<double> settings;  ///< the cheapest first
  ddacontact::Scene (*scene)(const Method& method, double setting);
  /// May take seconds, for a reference.
  Judge (*judge)();
  bool settles = false;    ///< the scene's first stage is not what is measured
  bool is_static = false;  ///< schemes do not matter, and midpoint steps alternate
};

/// How far a block's centre of mass has come, m.
ddacontact::Vec2 way(const ddacontact::Stepper& stepper, int block);

Problem sliding();        ///< a block on a slope under a force that sways
Problem colliding();      ///< an off-centre hit
Problem wave();           ///< a pressure wave along a bar of blocks
Problem arch();           ///< a semicircular arch under its weight
Problem resting_slope();  ///< Voronoi blocks on a slope, at rest
Problem sliding_slope();  ///< the same, let go
std::vector<Problem> all_problems();

}  // namespace error_time
