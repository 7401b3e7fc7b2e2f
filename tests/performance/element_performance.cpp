// Nanoseconds per element of polyfem's element matrices and of each step towards them, beside deal.II's
// bilinear quadrilateral when the project is built with it:
//   element_performance [--benchmark_filter=Stiffness]
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <tests/performance/quadrilaterals.hpp>
#include <tests/support/random_polygon.hpp>

#include <benchmark/benchmark.h>

using namespace polyfem;

namespace {

/// General convex quadrilaterals, those deal.II gets too.
const std::vector<Points>& quadrilaterals() {
  static const std::vector<Points> cells = performance::perturbed_quadrilaterals();
  return cells;
}

std::vector<Points> convex_polygons(int n) {
  std::mt19937 random(1);
  std::vector<Points> polygons;
  for (int k = 0; k < 256; ++k) polygons.push_back(support::random_convex_polygon(n, random));
  return polygons;
}

/// Runs `task(k)` for the next polygon each time.
template <typename Task>
void cycle(benchmark::State& state, std::size_t n_polygons, Task&& task) {
  std::size_t k = 0;
  for (auto _ : state) {
    task(k);
    benchmark::ClobberMemory();
    if (++k == n_polygons) k = 0;
  }
}

void QuadrilateralStiffness(benchmark::State& state) {
  const Mat3 D = elasticity_matrix(1, 0.3, Plane::strain);
  PolygonRule rule;
  TabulatedElement element;
  MatrixXd K;
  cycle(state, quadrilaterals().size(), [&](std::size_t k) {
    make_quadrilateral_rule(quadrilaterals()[k], 2, rule);
    tabulate(quadrilaterals()[k], rule, wachspress, GradientCorrection::on, element);
    stiffness(element, D, K);
  });
}
BENCHMARK(QuadrilateralStiffness);

void QuadrilateralRule(benchmark::State& state) {
  PolygonRule rule;
  cycle(state, quadrilaterals().size(),
        [&](std::size_t k) { make_quadrilateral_rule(quadrilaterals()[k], 2, rule); });
}
BENCHMARK(QuadrilateralRule);

/// Every polygon tabulated beforehand by Hammer's rule of this degree, or quadrilaterals by 2 x 2 points.
std::vector<TabulatedElement> tabulated(int n, int degree) {
  std::vector<TabulatedElement> elements;
  PolygonRule rule;
  for (const Points& polygon : degree == 0 ? quadrilaterals() : convex_polygons(n)) {
    elements.emplace_back();
    if (degree == 0) {
      make_quadrilateral_rule(polygon, 2, rule);
      tabulate(polygon, rule, wachspress, GradientCorrection::on, elements.back());
    } else {
      tabulate(polygon, hammer_rule(degree), wachspress, GradientCorrection::on, elements.back());
    }
  }
  return elements;
}

/// Vertices and degree of the rule on each triangle of the fan; 4 and 0: 2 x 2 points.
void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"n", "degree"})->Args({4, 0});
  for (const int n : {3, 4, 6, 8, 12})
    for (const int degree : {3, 5}) benchmark->Args({n, degree});
}

void FanRule(benchmark::State& state) {
  const std::vector<Points> polygons = convex_polygons(static_cast<int>(state.range(0)));
  PolygonRule rule;
  cycle(state, polygons.size(), [&](std::size_t k) { make_fan_rule(polygons[k], hammer_rule(3), rule); });
}
BENCHMARK(FanRule)->Arg(3)->Arg(4)->Arg(6)->Arg(8)->Arg(12);

template <GradientCorrection correction>
void Tabulate(benchmark::State& state) {
  const std::vector<TabulatedElement> elements =
      tabulated(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  const std::vector<Points> polygons =
      state.range(1) == 0 ? quadrilaterals() : convex_polygons(static_cast<int>(state.range(0)));
  TabulatedElement element;
  cycle(state, elements.size(),
        [&](std::size_t k) { tabulate(polygons[k], elements[k].rule, wachspress, correction, element); });
}
BENCHMARK(Tabulate<GradientCorrection::off>)->Apply(sizes);
BENCHMARK(Tabulate<GradientCorrection::on>)->Apply(sizes);

void Stiffness(benchmark::State& state) {
  const std::vector<TabulatedElement> elements =
      tabulated(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  const Mat3 D = elasticity_matrix(1, 0.3, Plane::strain);
  MatrixXd K;
  cycle(state, elements.size(), [&](std::size_t k) { stiffness(elements[k], D, K); });
}
BENCHMARK(Stiffness)->Apply(sizes);

void Mass(benchmark::State& state) {
  const std::vector<TabulatedElement> elements =
      tabulated(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  MatrixXd M;
  cycle(state, elements.size(), [&](std::size_t k) { mass(elements[k], M); });
}
BENCHMARK(Mass)->Apply(sizes);

}  // namespace

BENCHMARK_MAIN();
