// A cantilever of Voronoi cells in a process of its own, without deal.II: voronoi_cantilever CELLS. Prints
// one line of CSV: cells, unknowns, errors, the median over five repetitions of the seconds from the mesh to
// the solution, those for the mesh, and the largest memory the process has had, in MB.
#include <tests/performance/work_precision/meshes.hpp>
#include <tests/performance/work_precision/polyfem_run.hpp>

#include <polyfem/assembly/blas.hpp>

#include <sys/resource.h>
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>

using namespace work_precision;

namespace {

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1000;
}

void measure(const Problem& cantilever, int n_cells) {
  StopWatch watch;
  const polyfem::PolygonMesh mesh = voronoi_mesh(cantilever, n_cells);
  const double mesh_time = watch.lap();
  std::array<double, 5> seconds{};
  for (double& time : seconds)
    time = run_polyfem(cantilever, mesh, PolyfemElement::plain, false).stages.at("cholmod").total();
  const double memory = peak_megabytes();
  const Run run = run_polyfem(cantilever, mesh, PolyfemElement::plain);
  std::ranges::sort(seconds);
  std::printf("%d,%d,%.3e,%.3e,%.4f,%.4f,%.1f\n", mesh.n_cells(), run.accuracy.n_unknowns, run.accuracy.l2,
              run.accuracy.energy, seconds[2], mesh_time, memory);
}

}  // namespace

int main(int argc, char** argv) {
  const int n_cells = argc == 2 ? std::atoi(argv[1]) : 0;
  if (n_cells <= 0) {
    std::fprintf(stderr, "usage: voronoi_cantilever CELLS\n");
    return 2;
  }
  try {
    polyfem::pin_blas_to_one_thread();
    measure(cantilever(0.3), n_cells);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "voronoi_cantilever: error: %s\n", error.what());
    return 1;
  }
  return 0;
}
