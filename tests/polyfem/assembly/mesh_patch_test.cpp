// The patch test on whole meshes: displacements that are linear on the boundary are linear inside.
#include <polyfem/assembly/field_problem.hpp>
#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/mesh/generators.hpp>
#include <polyfem/mesh/mesh_boundary.hpp>
#include <polyfem/mesh/vertex_moves.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <tests/support/domains.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <ostream>

using namespace polyfem;
using support::uniform;

namespace {

/// x -> A x + b with an A that turns, stretches by up to 3 and shears.
struct AffineMap {
  explicit AffineMap(std::mt19937& random) {
    const double angle = uniform(0, 6.3, random);
    const Mat2 turn{{std::cos(angle), -std::sin(angle)}, {std::sin(angle), std::cos(angle)}};
    A = turn * Mat2{{uniform(1, 3, random), uniform(-0.5, 0.5, random)}, {0, 1}};
    b = Vec2(uniform(-5, 5, random), uniform(-5, 5, random));
  }
  Points operator()(const Points& x) const { return (A * x).colwise() + b; }

  Mat2 A;
  Vec2 b;
};

/// A way to make random meshes, and a basis for them.
struct Kind {
  const char* name;
  const Basis* basis;
  std::function<PolygonMesh(std::mt19937&)> make;
};
void PrintTo(const Kind& kind, std::ostream* out) {
  *out << kind.name;
}
int a_few(std::mt19937& random) {
  return std::uniform_int_distribution<int>(2, 3)(random);
}
PolygonMesh perturbed(PolygonMesh mesh, std::mt19937& random) {
  perturb_inner_vertices(mesh, 0.2, random());
  return mesh;
}
const Kind kinds[] = {
    {"voronoi", &wachspress,
     [](std::mt19937& random) {
       VoronoiOptions options;
       options.n_cells = 5 * a_few(random);
       options.seed = random();
       options.lloyd_steps = a_few(random) - 2;
       return voronoi(support::rectangle(1, 1), options);
     }},
    {"concave", &mean_value,
     [](std::mt19937& random) {
       const double depth = uniform(0.2, 0.8, random);
       return perturbed(chevrons({0, 0}, {1, 1}, a_few(random), a_few(random), depth), random);
     }},
    {"hanging", &mean_value,
     [](std::mt19937& random) {
       return rectangles_of_two_sizes({0, 0}, {1, 1}, a_few(random), a_few(random));
     }},
    {"bricks", &mean_value, [](std::mt19937& random) {
       return bricks({0, 0}, {1, 1}, a_few(random), a_few(random));
     }}};

/// The largest error of a vertex, relative to the largest displacement.
double patch_error(const PolygonMesh& mesh, const Basis& basis, GradientCorrection correction,
                   const Mat2& gradient) {
  const Mat3 D = elasticity_matrix(1, 0.3, Plane::strain);
  TabulatedElement element;
  FieldProblem problem(mesh, 2);
  problem.assemble([&](int, const PointsRef& polygon, MatrixXd& K, VectorXd&) {
    tabulate(polygon, hammer_rule(3), basis, correction, element);
    stiffness(element, D, K);
  });
  const Points exact = gradient * (mesh.vertices.colwise() - mesh.vertices.rowwise().mean());
  for (const int v : boundary_vertices(mesh))
    for (const int component : {0, 1}) problem.hold(v, component, exact(component, v));
  return (problem.solve() - exact.reshaped()).lpNorm<Eigen::Infinity>() / exact.lpNorm<Eigen::Infinity>();
}

class MeshPatchTest : public testing::TestWithParam<std::tuple<Kind, int>> {};
INSTANTIATE_TEST_SUITE_P(Kinds, MeshPatchTest,
                         testing::Combine(testing::ValuesIn(kinds), testing::Range(0, 5)),
                         [](const auto& test) {
                           return std::get<0>(test.param).name + std::to_string(std::get<1>(test.param));
                         });

TEST_P(MeshPatchTest, HoldsOnRandomMeshesWithFourPointsATriangleAndCorrectedGradients) {
  const auto& [kind, seed] = GetParam();
  std::mt19937 random(static_cast<unsigned>(seed));
  double worst = 0, worst_raw = 0;
  for (int trial = 0; trial < 50; ++trial) {
    PolygonMesh mesh = kind.make(random);
    const AffineMap map(random);
    mesh.vertices = map(mesh.vertices);
    const Mat2 gradient = Mat2::NullaryExpr([&] { return uniform(-1, 1, random); });
    worst = std::max(worst, patch_error(mesh, *kind.basis, GradientCorrection::on, gradient));
    worst_raw = std::max(worst_raw, patch_error(mesh, *kind.basis, GradientCorrection::off, gradient));
  }
  EXPECT_LE(worst, 1e-12);
  EXPECT_GT(worst_raw, 1e-3) << "without the correction the four points fail";
}

}  // namespace
