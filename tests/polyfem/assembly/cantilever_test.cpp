// Rates of convergence on Voronoi cells, and what B-bar does about locking, on a problem with a known answer.
#include <polyfem/assembly/field_problem.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/b_bar.hpp>
#include <polyfem/element/error_norms.hpp>
#include <polyfem/element/stress_recovery.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/mesh/mesh_boundary.hpp>
#include <polyfem/mesh/vertex_averages.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <tests/support/cantilever.hpp>

#include <gtest/gtest.h>

#include <Eigen/LU>

using namespace polyfem;

namespace {

enum class Formulation { plain, b_bar };

/// Relative errors of a solution.
struct Errors {
  double tip = 0;           ///< deflection of the end over the exact one
  double displacement = 0;  ///< L2
  double stress = 0;        ///< in the norm of the energy, by the points of the rule
  double at_vertices = 0;   ///< of each cell's own stresses, root mean square
  double averaged = 0;      ///< of those averaged over the cells around
  double direct = 0;        ///< of B(x) d there
};

class CantileverOfCells {
 public:
  CantileverOfCells(double poisson, Formulation formulation, int n_cells)
      : formulation_(formulation), mesh_(voronoi(exact_.domain(), {.n_cells = n_cells})) {
    exact_.poisson = poisson;
  }

  Errors solve() {
    FieldProblem problem(mesh_, 2);
    const Mat3 D = exact_.elasticity();
    problem.assemble([&](int, const PointsRef& polygon, MatrixXd& K, VectorXd&) {
      tabulate(polygon, hammer_rule(3), wachspress, GradientCorrection::on, element_);
      formulation_ == Formulation::plain ? stiffness(element_, D, K) : b_bar_stiffness(element_, D, K);
    });
    for (const int v : boundary_vertices(mesh_, [](const Vec2& x) { return x.x() == 0; }))
      for (int axis = 0; axis < 2; ++axis)
        problem.hold(v, axis, exact_.displacement(mesh_.vertices.col(v))[axis]);
    problem.add_edge_loads(boundary_edges(mesh_, at_end()), [&](const Vec2& x, const Vec2&) {
      return VectorXd(exact_.stress(x)({0, 2}));
    });
    return errors(problem.solve());
  }

 private:
  Region at_end() const {
    return [this](const Vec2& x) { return x.x() == exact_.length; };
  }

  Errors errors(const VectorXd& u) {
    const Mat3 D = exact_.elasticity(), compliance = D.inverse();
    const auto displacement = [&](const Vec2& x) { return exact_.displacement(x); };
    const auto stress = [&](const Vec2& x) { return exact_.stress(x); };
    Errors sum, norm;
    MatrixXd at_corners(3, mesh_.indices.size()), recovered;
    Tensors sigma;
    for (int c = 0; c < mesh_.n_cells(); ++c) {
      const Points polygon = mesh_.outline(c);
      const Index n = polygon.cols();
      VectorXd d(2 * n);
      for (Index i = 0; i < n; ++i) d.segment<2>(2 * i) = u.segment<2>(2 * mesh_.cell(c)[i]);
      tabulate(polygon, hammer_rule(5), wachspress, GradientCorrection::on, element_);
      if (formulation_ == Formulation::plain) {
        strains(element_, d, sigma);
        sigma = D * sigma;
      } else {
        b_bar_stresses(element_, D, d, sigma);
      }
      sum.displacement += squared_displacement_error(element_, d, displacement);
      norm.displacement += squared_displacement_error(element_, VectorXd::Zero(2 * n), displacement);
      sum.stress += squared_energy_error(element_, compliance, sigma, stress);  // of stresses, by compliance
      norm.stress += squared_energy_error(element_, compliance, Tensors::Zero(3, sigma.cols()), stress);
      extrapolate_to_vertices(polygon, element_, sigma, recovered);
      at_corners.middleCols(mesh_.offsets[c], n) = recovered;
      for (Index i = 0; i < n; ++i) {
        const Vec3 exact = exact_.stress(polygon.col(i));
        const Vec3 direct = D * strain_at(polygon, wachspress, d, polygon.col(i));
        sum.at_vertices += element_.area / n * (recovered.col(i) - exact).squaredNorm();
        sum.direct += element_.area / n * (direct - exact).squaredNorm();
        norm.at_vertices += element_.area / n * exact.squaredNorm();
      }
    }
    const MatrixXd averaged = vertex_averages(mesh_, at_corners);
    for (int c = 0; c < mesh_.n_cells(); ++c) {
      const double share = signed_area(mesh_.outline(c)) / static_cast<double>(mesh_.cell(c).size());
      for (const int v : mesh_.cell(c))
        sum.averaged += share * (averaged.col(v) - exact_.stress(mesh_.vertices.col(v))).squaredNorm();
    }
    const std::vector<int> end = boundary_vertices(mesh_, at_end());
    for (const int v : end) sum.tip += u[2 * v + 1] / exact_.displacement(mesh_.vertices.col(v)).y();
    return {sum.tip / static_cast<double>(end.size()),  std::sqrt(sum.displacement / norm.displacement),
            std::sqrt(sum.stress / norm.stress),        std::sqrt(sum.at_vertices / norm.at_vertices),
            std::sqrt(sum.averaged / norm.at_vertices), std::sqrt(sum.direct / norm.at_vertices)};
  }

  support::Cantilever exact_;
  Formulation formulation_;
  PolygonMesh mesh_;
  TabulatedElement element_;
};

/// Of errors on cells and on four times as many.
double rate(double coarse, double fine) {
  return std::log2(coarse / fine);
}

TEST(CantileverOfVoronoiCells, ConvergesWithRatesTwoAndOne) {
  const Errors coarse = CantileverOfCells(0.3, Formulation::plain, 250).solve(),
               fine = CantileverOfCells(0.3, Formulation::plain, 4000).solve();
  EXPECT_NEAR(rate(coarse.displacement, fine.displacement) / 2, 2, 0.05);
  EXPECT_NEAR(rate(coarse.stress, fine.stress) / 2, 1, 0.05);
  // Stress is best at vertices when it is extrapolated and averaged.
  for (const Errors& errors : {coarse, fine}) {
    EXPECT_LT(errors.at_vertices, 0.7 * errors.direct);
    EXPECT_LT(errors.averaged, 0.5 * errors.at_vertices);
  }
  EXPECT_NEAR(rate(coarse.at_vertices, fine.at_vertices) / 2, 1, 0.1);
  EXPECT_GT(rate(coarse.averaged, fine.averaged) / 2, 1.15);
}

TEST(CantileverOfVoronoiCells, IsMoreAccurateWithBBarAtAnyPoissonRatio) {
  for (const int n_cells : {250, 1000}) {
    const Errors plain = CantileverOfCells(0.3, Formulation::plain, n_cells).solve(),
                 b_bar = CantileverOfCells(0.3, Formulation::b_bar, n_cells).solve();
    EXPECT_LT(b_bar.displacement, plain.displacement / 4);
    EXPECT_LT(b_bar.stress, plain.stress);
    EXPECT_LT(b_bar.averaged, plain.averaged);
  }
}

class NearlyIncompressibleCantilever : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(PoissonRatios, NearlyIncompressibleCantilever, testing::Values(0.4999, 0.499999));

TEST_P(NearlyIncompressibleCantilever, LocksWithoutBBar) {
  EXPECT_LT(CantileverOfCells(GetParam(), Formulation::plain, 512).solve().tip, 0.6);
}

TEST_P(NearlyIncompressibleCantilever, DeflectsAsItShouldWithBBar) {
  const Errors coarse = CantileverOfCells(GetParam(), Formulation::b_bar, 128).solve(),
               fine = CantileverOfCells(GetParam(), Formulation::b_bar, 512).solve();
  EXPECT_NEAR(coarse.tip, 1, 0.006);
  EXPECT_NEAR(fine.tip, 1, 0.0018);
}

TEST_P(NearlyIncompressibleCantilever, HasTheStressesOfACompressibleOneWithBBar) {
  const Errors compressible = CantileverOfCells(0.3, Formulation::b_bar, 512).solve(),
               errors = CantileverOfCells(GetParam(), Formulation::b_bar, 512).solve();
  EXPECT_NEAR(errors.at_vertices / compressible.at_vertices, 1, 0.25);
  EXPECT_NEAR(errors.averaged / compressible.averaged, 1, 0.25);
}

}  // namespace
