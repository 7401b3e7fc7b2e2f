#include "conducting_mesh.hpp"

#include <gtest/gtest.h>

using namespace support;

namespace {

TEST(FieldProblem, RefusesWhatItCannotUse) {
  FieldProblem problem(mesh, 2);
  EXPECT_THROW(problem.solve(), Error) << "not assembled";
  EXPECT_THROW(problem.hold(-1, 0), Error);
  EXPECT_THROW(problem.hold(0, 2), Error);
  EXPECT_THROW(problem.hold(0, 0, std::nan("")), Error);
  EXPECT_THROW(problem.add_load(static_cast<int>(mesh.vertices.cols()), 0, 1), Error);
  const auto message_for = [&](const FieldProblem::CellMatrix& cell_matrix) -> std::string {
    try {
      problem.assemble(cell_matrix);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message_for(conducting).find("cell 0 is"), std::string::npos) << "one component instead of two";
  const std::string message = message_for([](int cell, const PointsRef& polygon, MatrixXd& K, VectorXd& f) {
    elastic(cell, polygon, K, f);
    if (cell == 7) K(0, 0) = std::nan("");
  });
  EXPECT_NE(message.find("cell 7"), std::string::npos) << message;
  EXPECT_THROW(problem.solve(), Error) << "what was assembled in part is not solved";

  PolygonMesh wrong = mesh;
  wrong.indices[5] = static_cast<int>(mesh.vertices.cols());
  EXPECT_THROW(FieldProblem(wrong, 1), Error);
  wrong = mesh;
  wrong.indices[1] = wrong.indices[0];
  EXPECT_THROW(FieldProblem(wrong, 1), Error);
}

TEST(FieldProblem, RefusesMeshesWhoseNumbersDoNotFit) {
  PolygonMesh wrong = mesh;
  wrong.offsets.clear();
  EXPECT_THROW(FieldProblem(wrong, 1), Error);
  wrong = mesh;
  wrong.offsets.back() += 2;
  EXPECT_THROW(FieldProblem(wrong, 1), Error);
  EXPECT_THROW(FieldProblem(mesh, 0), Error);
  const PolygonMesh nothing;
  EXPECT_THROW(FieldProblem(nothing, 2), Error);
  EXPECT_THROW(FieldProblem(mesh, -1), Error);
}

using Edges = std::vector<std::array<int, 2>>;

FieldProblem::EdgeLoad along_x(double x) {
  return [x](const Vec2&, const Vec2&) { return Vec2(x, 0); };
}

std::string refusal_of(FieldProblem& problem, const Edges& edges,
                       const FieldProblem::EdgeLoad& load = along_x(1)) {
  try {
    problem.add_edge_loads(edges, load);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(FieldProblem, RefusesLoadsItCannotUse) {
  FieldProblem problem(mesh, 2);
  const Edges edge{boundary_edges(mesh).front()};
  EXPECT_THROW(problem.add_edge_loads(Edges{{1, 99999}}, along_x(1)), Error);
  EXPECT_NE(refusal_of(problem, edge, along_x(std::nan(""))).find("is not finite"), std::string::npos);
  EXPECT_NE(refusal_of(problem, edge, [](const Vec2&, const Vec2&) { return VectorXd::Constant(1, 1.); })
                .find("has 1 entries"),
            std::string::npos)
      << "one component instead of two";
  EXPECT_THROW(problem.add_load(0, 0, INFINITY), Error);
}

//   6---7---8
//   | 2 | 3 |    Vertex 4 is inside.
//   3---4---5
//   | 0 | 1 |
//   0---1---2
TEST(FieldProblem, RefusesLoadsOnReversedAndMissingEdgesAndThenAddsNone) {
  const PolygonMesh four = rectangles({0, 0}, {2, 2}, 2, 2);
  FieldProblem problem(four, 2);
  problem.assemble(elastic);
  for (const int v : {0, 3, 6})
    for (const int axis : {0, 1}) problem.hold(v, axis);
  problem.solve();

  EXPECT_NE(
      refusal_of(problem, {{0, 1}, {5, 2}})
          .find("from vertex 5 at (2, 1) to vertex 2 at (2, 0) is to get a load, but cell 1 runs along it "
                "the other way: give its vertices as {2, 5}"),
      std::string::npos);
  for (const Edges& missing : {Edges{{0, 2}}, Edges{{0, 4}}, Edges{{1, 1}}, Edges{{8, 0}}})
    EXPECT_NE(refusal_of(problem, missing).find("no cell has that edge"), std::string::npos)
        << refusal_of(problem, missing);
  EXPECT_NE(refusal_of(problem, {{0, 4}}).find("from vertex 0 at (0, 0) to vertex 4 at (1, 1)"),
            std::string::npos);
  problem.solve();
  EXPECT_EQ(problem.solution().norm(), 0) << "what was refused has left no load";

  EXPECT_EQ(refusal_of(problem, {{2, 5}, {5, 8}}), "");
  EXPECT_EQ(refusal_of(problem, {{1, 4}, {4, 1}}), "") << "an inner edge, from either side";
  problem.solve();
  EXPECT_NEAR(problem.reactions()(Eigen::seq(0, Eigen::last, 2)).sum(), -4, 1e-12);
}

TEST(FieldProblem, RefusesPairsOfVerticesAsEdgesOfQuadraticCells) {
  const PolygonMesh quadratic = with_edge_midpoints(mesh);
  const auto on_top = [](const Vec2& x) { return x.y() == 1; };
  FieldProblem problem(quadratic, 2);
  const auto corners = boundary_edges(mesh, on_top), halves = boundary_edges(quadratic, on_top);
  for (const auto& edges : {corners, halves}) {
    try {
      problem.add_edge_loads(edges, pressure(1));
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("quadratic_edges"), std::string::npos) << error.what();
    }
    EXPECT_TRUE(problem.loads().isZero(0));
  }
  problem.add_edge_loads(quadratic_edges(quadratic, corners), pressure(1));
  EXPECT_NEAR(problem.loads().reshaped(2, quadratic.vertices.cols()).row(1).sum(), -3, 1e-13);
}

}  // namespace
