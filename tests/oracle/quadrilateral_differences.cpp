// How much Wachspress functions of a quadrilateral and deal.II's bilinear ones differ: unit squares with each
// corner moved by a given distance in a random direction. Prints a table, and fails unless the differences
// grow with the square of that distance: they are a product of what each pair of sides lacks to being
// parallel.
#include <tests/oracle/difference.hpp>
#include <tests/support/random_polygon.hpp>

#include <algorithm>
#include <cstdio>

using namespace polyfem;
using oracle::Difference;

namespace {

constexpr int n_quadrilaterals = 1000;
constexpr unsigned n_gauss = 8;

/// The same directions for any distance.
std::vector<Points> perturbed_squares(double distance) {
  std::mt19937 random(1);
  std::vector<Points> polygons;
  for (int k = 0; k < n_quadrilaterals; ++k) {
    Points square(2, 4);
    square << 0, 1, 1, 0,  //
        0, 0, 1, 1;
    for (Index i = 0; i < 4; ++i) square.col(i) += distance * support::random_direction(random);
    polygons.push_back(square);
  }
  return polygons;
}

struct Range {
  double median, largest;
};

Range range_of(const std::vector<Difference>& differences, double Difference::*kind) {
  std::vector<double> sorted;
  for (const Difference& difference : differences) sorted.push_back(difference.*kind);
  std::ranges::sort(sorted);
  return {sorted[sorted.size() / 2], sorted.back()};
}

}  // namespace

int main() {
  constexpr std::array kinds{&Difference::values, &Difference::gradients, &Difference::stiffness,
                             &Difference::mass};
  std::puts(
      "| corners moved by | N median | N largest | grad N median | grad N largest | K median | K largest "
      "| M median | M largest | rate |\n|---|---|---|---|---|---|---|---|---|---|");
  bool as_squares = true;
  double distance_before = 0, values_before = 0;
  for (const double distance : {0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2}) {
    const auto differences = oracle::differences(perturbed_squares(distance), n_gauss);
    std::printf("| %g |", distance);
    for (const auto kind : kinds) {
      const auto [median, largest] = range_of(differences, kind);
      std::printf(" %.1e | %.1e |", median, largest);
    }
    const double values = range_of(differences, &Difference::values).median;
    const double rate = std::log(values / values_before) / std::log(distance / distance_before);
    if (distance_before == 0) {
      std::puts(" |");
    } else {
      std::printf(" %.2f |\n", rate);
      as_squares &= distance > 0.05 || std::abs(rate - 2) < 0.05;
    }
    distance_before = distance;
    values_before = values;
  }
  if (!as_squares) std::puts("The differences do not grow with the square of the perturbation.");
  return as_squares ? 0 : 1;
}
