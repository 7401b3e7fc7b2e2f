/// \file The terms of the energy balance, as energy.csv and summary.json have them, in words.
#pragma once

#include <ddacontact/output/csv_table.hpp>

#include <array>
#include <string>
#include <vector>

namespace dda {

struct EnergyTerm {
  const char* column;       ///< of energy.csv, and its key in summary.json
  const char* curve;        ///< its name in charts
  const char *into, *from;  ///< of energy that went there or came from there
  int sign;                 ///< of the term among what energy went into
};

inline constexpr std::array<EnergyTerm, 9> energy_terms = {{
    {"kinetic", "kinetic", "motion (kinetic)", "motion (kinetic)", 1},
    {"elastic", "elastic", "deformation of blocks and joints (elastic)", "deformation (elastic)", 1},
    {"gravity", "gravity", "lifting weights (gravity)", "sinking weights (gravity)", 1},
    {"friction_dissipated", "friction", "friction", "friction", 1},
    {"numerical_dissipated", "numerical damping", "numerical damping of the time scheme", "the time scheme",
     1},
    {"external", "loads and supports", "work on loads and supports", "loads and supports", -1},
    {"damping_dissipated", "damping, impacts", "damping and impacts", "damping", 1},
    {"pushed_out", "pushing out", "penetration", "pushing penetration out", -1},
    {"plastic_dissipated", "bolts", "bolts that yield, slip or tear", "bolts", 1},
}};

/// One of them over time.
struct EnergyCurve {
  std::string name;
  std::vector<double> values;  ///< J/m
};

/// Of an energy.csv: those that a chart of them shows, which reach a thousandth of the largest.
std::vector<EnergyCurve> energy_curves(const ddacontact::CsvTable& table);

}  // namespace dda
