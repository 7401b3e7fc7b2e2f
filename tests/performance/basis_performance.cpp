// How long shape functions take, per point: ours give values and gradients, CGAL's coordinates values
// alone.
//
//     basis_performance --benchmark_filter=/n:8/
//
// The name of a benchmark says who, where the points are (inside: at most 0.9 of the way from the centre to
// the boundary; boundary: at 1e-9 of it from the boundary), the polygon's vertices n and how many points are
// requested at once.
#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <tests/support/random_polygon.hpp>

#include <CGAL/Barycentric_coordinates_2/Mean_value_coordinates_2.h>
#include <CGAL/Barycentric_coordinates_2/Wachspress_coordinates_2.h>
#include <CGAL/Simple_cartesian.h>
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

using namespace polyfem;

namespace {

enum class Place { inside, boundary };

/// An n-gon with jittered vertices on the unit circle.
Points polygon_of(int n) {
  std::mt19937 random(1);
  Points polygon(2, n);
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * (k + support::uniform(-0.1, 0.1, random)) / n;
    polygon.col(k) << std::cos(angle), std::sin(angle);
  }
  return polygon;
}

Points points_in(const Points& polygon, Place place, Index n_points) {
  std::mt19937 random(2);
  Points points(2, n_points);
  for (Index q = 0; q < n_points; ++q) {
    const Index k = q % polygon.cols();
    const double s = support::uniform(0.1, 0.9, random);
    const Vec2 on_edge = (1 - s) * polygon.col(k) + s * polygon.col((k + 1) % polygon.cols());
    points.col(q) = on_edge * (place == Place::inside ? support::uniform(0.1, 0.9, random) : 1 - 1e-9);
  }
  return points;
}

void report_time_of_a_point(benchmark::State& state, Index n_points) {
  state.counters["per_point"] =
      benchmark::Counter(static_cast<double>(n_points),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Values and gradients of a basis.
void time_ours(benchmark::State& state, const Basis& basis, Place place) {
  const Points polygon = polygon_of(static_cast<int>(state.range(0)));
  const Points points = points_in(polygon, place, state.range(1));
  ShapeTable table;
  for (auto _ : state) {
    basis.evaluate(polygon, points, table);
    benchmark::DoNotOptimize(table.dy.data());
    benchmark::ClobberMemory();
  }
  report_time_of_a_point(state, points.cols());
}

using Kernel = CGAL::Simple_cartesian<double>;
using CgalPolygon = std::vector<Kernel::Point_2>;

CgalPolygon cgal_points(const Points& points) {
  CgalPolygon result;
  for (const auto& point : points.colwise()) result.emplace_back(point.x(), point.y());
  return result;
}

/// Values of CGAL's coordinates, made once for the polygon.
template <class Coordinates>
void time_cgal(benchmark::State& state, CGAL::Barycentric_coordinates::Computation_policy_2 policy,
               Place place) {
  const Points polygon = polygon_of(static_cast<int>(state.range(0)));
  const CgalPolygon vertices = cgal_points(polygon),
                    points = cgal_points(points_in(polygon, place, state.range(1)));
  Coordinates coordinates(vertices, policy);
  std::vector<double> values(vertices.size() * points.size());
  for (auto _ : state) {
    auto next = values.begin();
    for (const Kernel::Point_2& point : points) next = coordinates(point, next);
    benchmark::DoNotOptimize(values.data());
    benchmark::ClobberMemory();
  }
  report_time_of_a_point(state, static_cast<Index>(points.size()));
}

template <class Function, class... Arguments>
void add(const std::string& name, Function function, Arguments... arguments) {
  benchmark::RegisterBenchmark(name.c_str(), function, arguments...)
      ->ArgNames({"n", "points"})
      ->ArgsProduct({{4, 5, 6, 8, 10, 12, 16, 20, 50}, {1, 4, 16, 64, 256}});
}

/// One of our bases beside CGAL's.
template <class Coordinates>
void add_basis(const std::string& name, const Basis& basis) {
  using Policy = CGAL::Barycentric_coordinates::Computation_policy_2;
  for (const auto& [place, where] : {std::pair(Place::inside, "/inside"), {Place::boundary, "/boundary"}}) {
    add(
        name + where, [&basis](benchmark::State& state, Place p) { time_ours(state, basis, p); }, place);
    add("cgal_" + name + "_fast" + where, time_cgal<Coordinates>, Policy::FAST, place);
    add("cgal_" + name + "_precise" + where, time_cgal<Coordinates>, Policy::PRECISE, place);
  }
}

}  // namespace

int main(int argc, char** argv) {
  namespace barycentric = CGAL::Barycentric_coordinates;
  benchmark::Initialize(&argc, argv);
  add_basis<barycentric::Wachspress_coordinates_2<CgalPolygon, Kernel>>("wachspress", wachspress);
  add_basis<barycentric::Mean_value_coordinates_2<CgalPolygon, Kernel>>("mean_value", mean_value);
  benchmark::RunSpecifiedBenchmarks();
}
