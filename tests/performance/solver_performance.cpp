// How long a problem on a mesh takes from the ready mesh to its solution, phase by phase:
//
//     solver_performance [CELLS ...]        1000 10000 100000 if none are given
//
// A cantilever of Voronoi cells in plane strain, held at its left end, loaded at the right one. One line of
// CSV for each number of cells: processor times in ms, the least of three; entries of the factor; the
// process' peak of memory so far, in MB. Start it with one number for that number's own peak.

#include <polyfem/assembly/blas.hpp>
#include <polyfem/assembly/field_problem.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/element/tabulated_element.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/mesh/mesh_boundary.hpp>
#include <polyfem/mesh/mesh_defects.hpp>
#include <polyfem/mesh/voronoi.hpp>

#include <sys/resource.h>
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <utility>
#include <vector>

using namespace polyfem;

namespace {

const Mat3 elasticity = elasticity_matrix(1, 0.3, Plane::strain);

/// Milliseconds of processor time since the last lap; there is one thread.
class Laps {
 public:
  double lap() {
    const std::clock_t now = std::clock();
    return 1e3 * static_cast<double>(now - std::exchange(last_, now)) / CLOCKS_PER_SEC;
  }

 private:
  std::clock_t last_ = std::clock();
};

void element_matrix(const PointsRef& polygon, MatrixXd& K) {
  static TabulatedElement element;
  tabulate(polygon, hammer_rule(3), wachspress, GradientCorrection::on, element);
  stiffness(element, elasticity, K);
}

constexpr const char* header =
    "cells,vertices,unknowns,check,elements,pattern,assembly,order,analysis,factorization,solution,"
    "whole,factor_entries,peak";
using Times = std::array<double, 9>;

/// The parts one by one, then the whole as a user writes it.
Times measure(const PolygonMesh& mesh, double& n_entries) {
  Times times;
  Laps laps;
  require_valid(mesh);
  times[0] = laps.lap();
  MatrixXd K;
  VectorXd f;
  for (int c = 0; c < mesh.n_cells(); ++c) element_matrix(mesh.outline(c), K);
  times[1] = laps.lap();
  {
    MeshMatrix matrix(mesh, 2);
    times[2] = laps.lap();
    for (int c = 0; c < mesh.n_cells(); ++c) {
      const Index n = 2 * static_cast<Index>(mesh.cell(c).size());
      if (K.rows() != n) K.setIdentity(n, n);
      matrix.add(c, K);
    }
    times[3] = laps.lap();
    for (Index k = 0; k < matrix.lower().rows(); ++k) matrix.lower().coeffRef(k, k) += 1e3;
    std::vector<int> order;
    laps.lap();
    for (const int v : minimum_degree_order(matrix.first_neighbours(), matrix.neighbours()))
      order.insert(order.end(), {2 * v, 2 * v + 1});
    times[4] = laps.lap();
    Cholesky cholesky;
    cholesky.analyze(matrix.lower(), order);
    times[5] = laps.lap();
    if (!cholesky.factorize(matrix.lower())) std::abort();
    times[6] = laps.lap();
    VectorXd x;
    cholesky.solve(VectorXd::Ones(matrix.lower().rows()), x);
    times[7] = laps.lap();
    n_entries = cholesky.n_factor_entries();
  }
  laps.lap();
  FieldProblem problem(mesh, 2);
  problem.assemble([](int, const PointsRef& polygon, MatrixXd& cell_matrix, VectorXd&) {
    element_matrix(polygon, cell_matrix);
  });
  for (const int v : boundary_vertices(mesh, [](const Vec2& x) { return x.x() == 0; }))
    for (const int component : {0, 1}) problem.hold(v, component);
  const auto right = boundary_edges(mesh, [](const Vec2& x) { return x.x() == 4; });
  problem.add_edge_loads(right, [](const Vec2&, const Vec2&) { return Vec2(0, -1); });
  problem.solve();
  times[8] = laps.lap();
  return times;
}

}  // namespace

int main(int n_arguments, char** arguments) {
  pin_blas_to_one_thread();
  std::vector<int> sizes;
  for (int k = 1; k < n_arguments; ++k) sizes.push_back(std::atoi(arguments[k]));
  if (sizes.empty()) sizes = {1000, 10000, 100000};
  std::puts(header);
  for (const int n_cells : sizes) {
    Points domain(2, 4);
    domain << 0, 4, 4, 0, 0, 0, 1, 1;
    VoronoiOptions options;
    options.n_cells = n_cells;
    const PolygonMesh mesh = voronoi(domain, options);
    double n_entries = 0;
    Times least = measure(mesh, n_entries);
    for (int repetition = 1; repetition < 3; ++repetition) {
      const Times times = measure(mesh, n_entries);
      for (std::size_t k = 0; k < times.size(); ++k) least[k] = std::min(least[k], times[k]);
    }
    std::printf("%d,%d,%d", mesh.n_cells(), static_cast<int>(mesh.vertices.cols()),
                2 * static_cast<int>(mesh.vertices.cols()));
    for (const double time : least) std::printf(",%.2f", time);
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    std::printf(",%.3g,%.0f\n", n_entries, static_cast<double>(usage.ru_maxrss) / 1024);
  }
}
