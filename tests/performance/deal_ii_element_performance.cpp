// The stiffness of the bilinear quadrilateral by deal.II's FEValues at its best: a scalar element, so that
// each gradient is computed once and not once a component, only what the stiffness needs, 2 x 2 points, plain
// doubles and the upper triangle in the loop.
#include <tests/performance/quadrilaterals.hpp>

#include <benchmark/benchmark.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/tria.h>

#include <array>

namespace {

constexpr int n_vertices = 4;
using Matrix = std::array<double, 4 * n_vertices * n_vertices>;

/// The quadrilaterals as cells of their own: FEValues does not look at neighbours.
void make_cells(dealii::Triangulation<2>& triangulation) {
  std::vector<dealii::Point<2>> points;
  std::vector<dealii::CellData<2>> cells;
  for (const polyfem::Points& polygon : performance::perturbed_quadrilaterals()) {
    dealii::CellData<2> cell(n_vertices);
    for (const int k : {0, 1, 3, 2}) {  // deal.II counts row by row
      cell.vertices[points.size() % n_vertices] = static_cast<unsigned>(points.size());
      points.emplace_back(polygon(0, k), polygon(1, k));
    }
    cells.push_back(cell);
  }
  triangulation.create_triangulation(points, cells, dealii::SubCellData());
}

void add_stiffness(const dealii::FEValues<2>& values, double lambda, double mu, Matrix& K) {
  K.fill(0);
  for (unsigned q = 0; q < values.n_quadrature_points; ++q) {
    const double wl = values.JxW(q) * lambda, wm = values.JxW(q) * mu;
    for (unsigned j = 0; j < n_vertices; ++j) {
      const dealii::Tensor<1, 2>& gj = values.shape_grad(j, q);
      for (unsigned i = 0; i <= j; ++i) {
        const dealii::Tensor<1, 2>& gi = values.shape_grad(i, q);
        const double xx = gi[0] * gj[0], yy = gi[1] * gj[1], xy = gi[0] * gj[1], yx = gi[1] * gj[0];
        double* block = &K[(2 * j) * 8 + 2 * i];
        block[0] += (wl + 2 * wm) * xx + wm * yy;
        block[1] += wl * yx + wm * xy;
        block[8] += wl * xy + wm * yx;
        block[9] += (wl + 2 * wm) * yy + wm * xx;
      }
    }
  }
  for (unsigned j = 0; j < 8; ++j)
    for (unsigned i = 0; i < j; ++i) K[i * 8 + j] = K[j * 8 + i];
}

void DealIIQuadrilateralStiffness(benchmark::State& state) {
  dealii::Triangulation<2> triangulation;
  make_cells(triangulation);
  const dealii::FE_Q<2> element(1);
  const dealii::QGauss<2> quadrature(2);
  dealii::FEValues<2> values(element, quadrature, dealii::update_gradients | dealii::update_JxW_values);
  Matrix K;
  auto cell = triangulation.begin_active();
  for (auto _ : state) {
    values.reinit(cell);
    add_stiffness(values, 0.5769, 0.3846, K);
    benchmark::DoNotOptimize(K);
    benchmark::ClobberMemory();
    if (++cell == triangulation.end()) cell = triangulation.begin_active();
  }
}
BENCHMARK(DealIIQuadrilateralStiffness);

void DealIIReinit(benchmark::State& state) {
  dealii::Triangulation<2> triangulation;
  make_cells(triangulation);
  const dealii::FE_Q<2> element(1);
  const dealii::QGauss<2> quadrature(2);
  dealii::FEValues<2> values(element, quadrature, dealii::update_gradients | dealii::update_JxW_values);
  auto cell = triangulation.begin_active();
  for (auto _ : state) {
    values.reinit(cell);
    benchmark::ClobberMemory();
    if (++cell == triangulation.end()) cell = triangulation.begin_active();
  }
}
BENCHMARK(DealIIReinit);

}  // namespace
