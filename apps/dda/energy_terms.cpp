#include "energy_terms.hpp"

#include <algorithm>
#include <cmath>

namespace dda {

namespace {

constexpr double visible = 1e-3;  // of the largest

double largest_of(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

}  // namespace

std::vector<EnergyCurve> energy_curves(const ddacontact::CsvTable& table) {
  std::vector<EnergyCurve> curves;
  double largest = 0;
  for (const EnergyTerm& term : energy_terms) {
    if (std::ranges::count(table.header(), term.column) == 0) continue;  // results of an older version
    curves.push_back({term.curve, table.numbers(term.column)});
    largest = std::max(largest, largest_of(curves.back().values));
  }
  std::erase_if(curves,
                [&](const EnergyCurve& curve) { return !(largest_of(curve.values) > visible * largest); });
  return curves;
}

}  // namespace dda
