// Error against time and unknowns: work_precision FILE.csv [--quick]. One thread; every time is the median of
// five repetitions, in which all methods take turns.
#include <tests/performance/work_precision/deal_ii_run.hpp>
#include <tests/performance/work_precision/measurement_table.hpp>
#include <tests/performance/work_precision/meshes.hpp>
#include <tests/performance/work_precision/polyfem_run.hpp>
#include <tests/performance/work_precision/reference.hpp>

#include <polyfem/assembly/blas.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string_view>

using namespace work_precision;

namespace {

struct Method {
  std::string name;
  Cells cells;
  std::function<Run(const Problem&, const polyfem::PolygonMesh&, bool with_errors)> run;
};

Method of_polyfem(std::string name, Cells cells, PolyfemElement element = PolyfemElement::plain) {
  return {std::move(name), cells,
          [element](const Problem& problem, const polyfem::PolygonMesh& mesh, bool with_errors) {
            return run_polyfem(problem, mesh, element, with_errors);
          }};
}

Method of_deal_ii(std::string name, Cells cells, DealIIElement element) {
  return {std::move(name), cells,
          [element](const Problem& problem, const polyfem::PolygonMesh& mesh, bool with_errors) {
            // Conjugate gradients fall back further with every refinement, most of all near
            // incompressibility.
            constexpr int most_cells = 2500;
            const bool with_cg = mesh.n_cells() <= most_cells && !problem.nearly_incompressible;
            return run_deal_ii(problem, mesh, element, with_cg, with_errors);
          }};
}

std::vector<Method> methods_for(const Problem& problem) {
  std::vector<Method> methods;
  if (problem.nearly_incompressible) {
    methods = {of_polyfem("polyfem quadrilaterals B-bar", Cells::quadrilaterals, PolyfemElement::b_bar),
               of_polyfem("polyfem hexagons B-bar", Cells::hexagons, PolyfemElement::b_bar),
               of_polyfem("polyfem Voronoi B-bar", Cells::voronoi, PolyfemElement::b_bar),
               of_polyfem("polyfem Voronoi", Cells::voronoi),
               of_deal_ii("deal.II Q1 reduced", Cells::quadrilaterals, DealIIElement::q1_reduced)};
  } else {
    methods = {of_polyfem("polyfem quadrilaterals", Cells::quadrilaterals),
               of_polyfem("polyfem hexagons", Cells::hexagons), of_polyfem("polyfem Voronoi", Cells::voronoi),
               of_polyfem("polyfem Voronoi virtual", Cells::voronoi, PolyfemElement::virtual_element)};
  }
  methods.push_back(
      of_polyfem("polyfem quadrilaterals quadratic", Cells::quadrilaterals, PolyfemElement::quadratic));
  methods.push_back(of_polyfem("polyfem Voronoi quadratic", Cells::voronoi, PolyfemElement::quadratic));
  methods.push_back(of_deal_ii("deal.II Q1", Cells::quadrilaterals, DealIIElement::q1));
  methods.push_back(of_deal_ii("deal.II P1", Cells::triangles, DealIIElement::p1));
  methods.push_back(of_deal_ii("deal.II Q2", Cells::quadrilaterals, DealIIElement::q2));
  return methods;
}

double median(std::vector<Stages> stages, double Stages::*stage) {
  const auto middle = stages.begin() + static_cast<std::ptrdiff_t>(stages.size() / 2);
  std::ranges::nth_element(stages, middle, {}, stage);
  return (*middle).*stage;
}

/// All repetitions of one method on one mesh.
struct Samples {
  Accuracy accuracy;
  int n_cells = 0;
  std::map<std::string, std::vector<Stages>> stages;
};

void take_sample(const Problem& problem, const Method& method, int n_rows, Samples& samples) {
  StopWatch watch;
  const polyfem::PolygonMesh mesh = make_mesh(problem, method.cells, n_rows);
  const double mesh_time = watch.lap();
  const bool is_first = samples.n_cells == 0;
  const Run run = method.run(problem, mesh, is_first);
  if (is_first) samples.accuracy = run.accuracy;
  samples.n_cells = mesh.n_cells();
  for (auto [solver, stages] : run.stages) {
    if (stages.mesh == 0) stages.mesh = mesh_time;  // deal.II's own is that of its triangulation
    samples.stages[solver].push_back(stages);
  }
}

void append(const Problem& problem, const Method& method, const Samples& samples,
            std::vector<Measurement>& table) {
  for (const auto& [solver, stages] : samples.stages) {
    const auto time = [&](double Stages::*stage) { return median(stages, stage); };
    table.push_back({problem.name, method.name, solver, samples.n_cells, samples.accuracy.n_unknowns,
                     samples.accuracy.l2, samples.accuracy.energy, time(&Stages::mesh),
                     time(&Stages::pattern), time(&Stages::assembly), time(&Stages::factorization),
                     time(&Stages::solve)});
    const Measurement& m = table.back();
    std::printf("%-22s %-28s %-8s %7d unknowns  L2 %.2e  energy %.2e  %8.2f ms\n", m.problem.c_str(),
                m.method.c_str(), m.solver.c_str(), m.n_unknowns, m.l2, m.energy, 1e3 * m.total());
  }
}

void measure(const Problem& problem, int n_rows, int repetitions, std::vector<Measurement>& table) {
  const std::vector<Method> methods = methods_for(problem);
  std::vector<Samples> samples(methods.size());
  for (int repetition = 0; repetition < repetitions; ++repetition)
    for (std::size_t k = 0; k < methods.size(); ++k) take_sample(problem, methods[k], n_rows, samples[k]);
  for (std::size_t k = 0; k < methods.size(); ++k) {
    if (!problem.exact()) compare_with_reference(problem, samples[k].accuracy);
    append(problem, methods[k], samples[k], table);
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc == 3 && std::string_view(argv[2]) == "--quick";
  if (argc != 2 && !quick) {
    std::fprintf(stderr, "usage: work_precision FILE.csv [--quick]\n");
    return 2;
  }
  try {
    std::printf("BLAS %s\n", polyfem::pin_blas_to_one_thread().c_str());
    std::vector<Measurement> table;
    for (const Method& method : methods_for(cantilever(0.4999))) {  // libraries are loaded and set up
      Samples unused;
      take_sample(cantilever(0.3), method, 4, unused);
    }
    for (const Problem& problem : all_problems())
      for (int n_rows = 8; n_rows <= (quick ? 16 : 128); n_rows *= 2)
        measure(problem, n_rows, quick ? 1 : 5, table);
    write_table(argv[1], table);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "work_precision: error: %s\n", error.what());
    return 1;
  }
  return 0;
}
