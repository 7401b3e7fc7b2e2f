// Mean value functions at many points against CGAL's, which gives values alone:
// mean_value_performance [--benchmark_filter=...]. Times are of 64 points of a convex polygon.
#include <polyfem/basis/mean_value.hpp>
#include <polyfem/testing/sample_polygons.hpp>

#include <CGAL/Barycentric_coordinates_2/Mean_value_coordinates_2.h>
#include <CGAL/Simple_cartesian.h>
#include <benchmark/benchmark.h>

using namespace polyfem;

namespace {

struct Sample {
  explicit Sample(benchmark::State& state) {
    SampleRandom random(1);
    polygon = convex_sample(static_cast<int>(state.range(0)), random);
    points = inner_points(polygon, 64);
  }
  Points polygon, points;
};

void count_points(benchmark::State& state, const Sample& sample) {
  state.SetItemsProcessed(state.iterations() * sample.points.cols());
}

/// Values and gradients.
void mean_value_of_many_points(benchmark::State& state) {
  const Sample sample(state);
  ShapeTable table;
  for ([[maybe_unused]] const auto _ : state) {
    mean_value.evaluate(sample.polygon, sample.points, table);
    benchmark::DoNotOptimize(table.dx.data());
  }
  count_points(state, sample);
}

void mean_value_point_by_point(benchmark::State& state) {
  const Sample sample(state);
  ShapeTable table;
  for ([[maybe_unused]] const auto _ : state)
    for (Index q = 0; q < sample.points.cols(); ++q) {
      mean_value.evaluate(sample.polygon, sample.points.col(q), table);
      benchmark::DoNotOptimize(table.dx.data());
    }
  count_points(state, sample);
}

/// Values.
template <CGAL::Barycentric_coordinates::Computation_policy_2 policy>
void cgal_mean_value(benchmark::State& state) {
  using Kernel = CGAL::Simple_cartesian<double>;
  using CgalPoints = std::vector<Kernel::Point_2>;
  const Sample sample(state);
  const auto cgal_points = [](const Points& points) {
    CgalPoints result;
    for (const Vec2 x : points.colwise()) result.emplace_back(x.x(), x.y());
    return result;
  };
  const CgalPoints vertices = cgal_points(sample.polygon), points = cgal_points(sample.points);
  CGAL::Barycentric_coordinates::Mean_value_coordinates_2<CgalPoints, Kernel> coordinates(vertices, policy);
  std::vector<double> values(vertices.size());
  for ([[maybe_unused]] const auto _ : state)
    for (const Kernel::Point_2& x : points) {
      coordinates(x, values.begin());
      benchmark::DoNotOptimize(values.data());
    }
  count_points(state, sample);
}

using enum CGAL::Barycentric_coordinates::Computation_policy_2;

void numbers_of_vertices(benchmark::internal::Benchmark* benchmark) {
  for (const int n : {4, 6, 8, 12, 20, 50}) benchmark->Arg(n);
}

BENCHMARK(mean_value_of_many_points)->Apply(numbers_of_vertices);
BENCHMARK(mean_value_point_by_point)->Apply(numbers_of_vertices);
BENCHMARK(cgal_mean_value<FAST>)->Apply(numbers_of_vertices);
BENCHMARK(cgal_mean_value<PRECISE>)->Apply(numbers_of_vertices);

}  // namespace

BENCHMARK_MAIN();
