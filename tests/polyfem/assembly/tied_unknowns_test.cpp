// Rollers on inclined edges, ties and periodic cells, with and without symmetry of the matrix.
#include <polyfem/assembly/field_problem.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/core/error.hpp>
#include <polyfem/element/diffusion.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/mesh/generators.hpp>
#include <polyfem/mesh/mesh_boundary.hpp>
#include <polyfem/mesh/periodic_vertices.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <tests/support/domains.hpp>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

using namespace polyfem;

namespace {

const double young = 2, poisson = 0.3;
const Mat3 plane_stress = elasticity_matrix(young, poisson, Plane::stress);

TabulatedElement element_of(const PointsRef& cell) {
  TabulatedElement element;
  tabulate(cell, dunavant_rule(4), wachspress, GradientCorrection::on, element);
  return element;
}

void elastic(int, const PointsRef& cell, MatrixXd& K, VectorXd&) {
  stiffness(element_of(cell), plane_stress, K);
}

template <typename Work>
std::string message_of(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// A bar 3 x 1, turned by 30 degrees, whose lower end rolls on its inclined edge.
struct TurnedBar {
  Eigen::Rotation2Dd turn{std::numbers::pi / 6};
  PolygonMesh mesh = [this] {
    PolygonMesh straight = voronoi(support::rectangle(3, 1), {.n_cells = 60});
    straight.vertices = turn.toRotationMatrix() * straight.vertices.eval();
    return straight;
  }();
  Vec2 along = turn * Vec2(1, 0);

  Region end(double at) const {
    return [this, at](const Vec2& x) { return std::abs(x.dot(along) - at) < 1e-12; };
  }
  template <typename Problem>
  void support(Problem& problem) const {
    for (const int v : boundary_vertices(mesh, end(0))) {
      if (mesh.vertices.col(v).norm() < 1e-12)
        for (const int axis : {0, 1}) problem.hold(v, axis);
      else
        problem.roll(v, -2 * along);
    }
    problem.add_edge_loads(boundary_edges(mesh, end(3)), pressure(-0.1));
  }
};

class Rollers : public testing::TestWithParam<Symmetry> {};
INSTANTIATE_TEST_SUITE_P(WithAndWithoutSymmetry, Rollers,
                         testing::Values(Symmetry::symmetric, Symmetry::none));

TEST_P(Rollers, OnAnInclinedEdgeLetABarContractAcross) {
  const TurnedBar bar;
  FieldProblem problem(bar.mesh, 2, GetParam());
  bar.support(problem);
  problem.assemble(elastic);
  const VectorXd u = problem.solve();
  const Mat2 strain = bar.turn.toRotationMatrix() * Vec2(1, -poisson).asDiagonal() *
                      bar.turn.toRotationMatrix().transpose() * (0.1 / young);
  EXPECT_LT((u - (strain * bar.mesh.vertices).reshaped()).lpNorm<Eigen::Infinity>(), 1e-13);
  const Eigen::Map<const Points> reactions(problem.reactions().data(), 2, bar.mesh.vertices.cols());
  EXPECT_LT((reactions.rowwise().sum() + 0.1 * bar.along).norm(), 1e-13);
  const Vec2 across(-bar.along.y(), bar.along.x());
  EXPECT_LT((across.transpose() * reactions).lpNorm<Eigen::Infinity>(), 1e-13) << "rollers bear no shear";
}

TEST(Rollers, ThatDoNotHoldAreSaidToMoveAlongTheirEdge) {
  const TurnedBar bar;
  FieldProblem problem(bar.mesh, 2);
  problem.assemble(elastic);
  for (const int v : boundary_vertices(bar.mesh, bar.end(0))) problem.roll(v, bar.along);
  const std::string message = message_of([&] { problem.solve(); });
  EXPECT_NE(message.find("held too little"), std::string::npos) << message;
  EXPECT_NE(message_of([&] { problem.roll(0, {0, 0}); }).find("normal"), std::string::npos);
  EXPECT_NE(message_of([&] {
              FieldProblem(bar.mesh, 1).roll(0, {0, 1});
            }).find("two components"),
            std::string::npos);
}

TEST(Ties, JoinTwoMeshesAsOneMeshJoinsThem) {
  const PolygonMesh whole = rectangles({0, 0}, {4, 2}, 8, 4), left = rectangles({0, 0}, {2, 2}, 4, 4),
                    right = rectangles({2, 0}, {4, 2}, 4, 4);
  PolygonMesh both = left;
  const int n_left = static_cast<int>(left.vertices.cols());
  both.vertices.resize(2, n_left + right.vertices.cols());
  both.vertices << left.vertices, right.vertices;
  for (const int v : right.indices) both.indices.push_back(n_left + v);
  for (std::size_t c = 1; c < right.offsets.size(); ++c)
    both.offsets.push_back(left.offsets.back() + right.offsets[c]);

  const auto solved = [](const PolygonMesh& mesh, bool tied) {
    FieldProblem problem(mesh, 2);
    problem.assemble(elastic);
    for (Index v = 0; v < mesh.vertices.cols(); ++v) {
      const auto vertex = static_cast<int>(v);
      const Vec2 x = mesh.vertices.col(v);
      if (x.x() == 0)
        for (const int axis : {0, 1}) problem.hold(vertex, axis);
      if (x.x() == 4) problem.add_load(vertex, 1, 0.01 * (1 + x.y()));
      if (!tied || x.x() != 2) continue;
      for (int w = 0; w < vertex; ++w)
        if (mesh.vertices.col(w) == x)
          for (const int axis : {0, 1}) problem.tie(vertex, axis, {{w, axis}});
    }
    problem.solve();
    return std::pair(problem.solution(), problem.reactions());
  };
  const auto [u, reactions] = solved(whole, false);
  const auto [u_tied, reactions_tied] = solved(both, true);
  for (Index v = 0; v < both.vertices.cols(); ++v)
    for (Index w = 0; w < whole.vertices.cols(); ++w)
      if (both.vertices.col(v) == whole.vertices.col(w)) {
        EXPECT_LT((u_tied.segment<2>(2 * v) - u.segment<2>(2 * w)).norm(), 1e-12);
      }
  EXPECT_NEAR(reactions_tied.sum(), reactions.sum(), 1e-12) << "ties exert nothing on the whole";

  FieldProblem loose(both, 2);
  loose.assemble(elastic);
  for (const int v : boundary_vertices(both, [](const Vec2& x) { return x.x() == 0; }))
    for (const int axis : {0, 1}) loose.hold(v, axis);
  EXPECT_NE(message_of([&] { loose.solve(); }).find("held too little"), std::string::npos);
}

/// Effective conductivities of layers of equal thickness, across and along them.
TEST(PeriodicCells, OfLayersConductAsTheirMeansSay) {
  const PolygonMesh mesh = rectangles({0, 0}, {1, 1}, 4, 4);
  const double k_one = 1, k_other = 5;
  const auto conducting = [&](int, const PointsRef& cell, MatrixXd& K, VectorXd&) {
    diffusion(element_of(cell), Mat2::Identity() * (cell.row(0).mean() < 0.5 ? k_one : k_other), K);
  };
  const auto flux = [&](const Vec2& gradient) {
    FieldProblem problem(mesh, 1);
    problem.assemble(conducting);
    problem.hold(0, 0);
    for (const Vec2& period : {Vec2(1, 0), Vec2(0, 1)})
      for (const auto& [v, moved] : periodic_vertices(mesh, period))
        problem.tie(moved, 0, {{v, 0}}, gradient.dot(period));
    const VectorXd u = problem.solve();
    return u.dot(problem.full_matrix() * u);
  };
  EXPECT_NEAR(flux({1, 0}), 2 / (1 / k_one + 1 / k_other), 1e-12);
  EXPECT_NEAR(flux({0, 1}), (k_one + k_other) / 2, 1e-12);
  const PolygonMesh irregular = voronoi(support::rectangle(1, 1), {.n_cells = 30});
  EXPECT_NE(message_of([&] {
              periodic_vertices(irregular, {1, 0});
            }).find("same vertices"),
            std::string::npos);
}

/// u' = k u'' in a strip: u = (exp(x / k) - 1) / (exp(1 / k) - 1).
double convection_error(int n) {
  const double k = 0.2;
  const PolygonMesh mesh = hexagons({0, 0}, {1, 0.5}, n, n / 2);
  FieldProblem problem(mesh, 1, Symmetry::none);
  problem.assemble([&](int, const PointsRef& cell, MatrixXd& K, VectorXd&) {
    const TabulatedElement element = element_of(cell);
    diffusion(element, k * Mat2::Identity(), K);
    K += element.values.transpose() * element.rule.weights.asDiagonal() * element.dx;
  });
  for (const int v : boundary_vertices(mesh))
    if (const double x = mesh.vertices(0, v); x == 0 || x == 1) problem.hold(v, 0, x);
  const VectorXd u = problem.solve();
  const VectorXd exact = ((mesh.vertices.row(0).array() / k).exp() - 1) / (std::exp(1 / k) - 1);
  return (u - exact).lpNorm<Eigen::Infinity>();
}

TEST(WithoutSymmetry, ConvectionConvergesAtSecondOrder) {
  const double coarse = convection_error(12), fine = convection_error(24), finest = convection_error(48);
  EXPECT_LT(finest, 2e-3);
  EXPECT_GT(std::log2(coarse / fine), 1.6);
  EXPECT_GT(std::log2(fine / finest), 1.8);
}

TEST(WithoutSymmetry, ASingularMatrixIsRefused) {
  for (const int n : {1, 3, 10, 30}) {
    const PolygonMesh mesh = rectangles({0, 0}, {1, 1}, n, n);
    FieldProblem problem(mesh, 2, Symmetry::none);
    problem.assemble(elastic);
    EXPECT_NE(message_of([&] { problem.solve(); }).find("singular"), std::string::npos) << n;
    EXPECT_NE(message_of([&] { problem.matrix(); }).find("full_matrix"), std::string::npos) << n;
  }
}

TEST(Ties, InACircleOrOnPrescribedDofsAreRefused) {
  const PolygonMesh mesh = rectangles({0, 0}, {1, 1}, 2, 2);
  FieldProblem problem(mesh, 1);
  problem.assemble([](int, const PointsRef& cell, MatrixXd& K, VectorXd&) {
    diffusion(element_of(cell), Mat2::Identity(), K);
  });
  problem.hold(0, 0, 1);
  EXPECT_NE(message_of([&] { problem.tie(0, 0, {{1, 0}}); }).find("is held"), std::string::npos);
  problem.tie(1, 0, {{2, 0}});
  EXPECT_NE(message_of([&] { problem.hold(1, 0); }).find("is tied"), std::string::npos);
  problem.tie(2, 0, {{1, 0}});
  EXPECT_NE(message_of([&] { problem.solve(); }).find("tied to itself"), std::string::npos);
  problem.tie(2, 0, {{0, 0, 3}}, 1);
  const VectorXd& u = problem.solve();
  EXPECT_EQ(u[2], 4);
  EXPECT_EQ(u[1], 4);
}

}  // namespace
