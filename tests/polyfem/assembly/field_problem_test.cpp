#include "conducting_mesh.hpp"

#include <gtest/gtest.h>

using namespace support;

namespace {

TEST(FieldProblem, FindsALinearPotentialFromItsBoundary) {
  FieldProblem problem(mesh, 1);
  problem.assemble(conducting);
  const VectorXd exact = 5 + (mesh.vertices.row(0) - 2 * mesh.vertices.row(1)).transpose().array();
  for (const int v : boundary_vertices(mesh)) problem.hold(v, 0, exact[v]);
  EXPECT_LT((problem.solve() - exact).lpNorm<Eigen::Infinity>(), 1e-13);
  for (const int v : boundary_vertices(mesh)) EXPECT_EQ(problem.solution()[v], exact[v]) << "to the bit";
  EXPECT_NEAR(problem.reactions().sum(), 0, 1e-12) << "what flows in flows out";
}

TEST(FieldProblem, TakesFluxesThroughTheBoundary) {
  FieldProblem problem(mesh, 1);
  problem.assemble(conducting);
  for (const int v : boundary_vertices(mesh, at_left)) problem.hold(v, 0, 1);
  const Vec2 gradient(0.7, 0);
  problem.add_edge_loads(
      boundary_edges(mesh, [](const Vec2& x) { return !at_left(x) || x.y() == 0 || x.y() == 1; }),
      [&](const Vec2&, const Vec2& normal) { return VectorXd::Constant(1, gradient.dot(normal)); });
  const VectorXd exact = 1 + 0.7 * mesh.vertices.row(0).transpose().array();
  EXPECT_LT((problem.solve() - exact).lpNorm<Eigen::Infinity>(), 1e-13);
}

TEST(FieldProblem, CarriesAQuadraticTractionExactlyToItsReactions) {
  FieldProblem problem(mesh, 2);
  problem.assemble(elastic);
  clamp_left(problem);
  problem.add_edge_loads(boundary_edges(mesh, at_right),
                         [](const Vec2& x, const Vec2&) { return Vec2(1, 6 * x.y() * (1 - x.y())); });
  problem.add_load(boundary_vertices(mesh, at_left)[0], 1, 17);  // straight into a support
  problem.solve();
  const VectorXd reactions = problem.reactions();
  Vec2 sum = Vec2::Zero();
  double moment = 0;
  for (Index v = 0; v < mesh.vertices.cols(); ++v) {
    const Vec2 force = reactions.segment<2>(2 * v);
    sum += force;
    moment += cross(mesh.vertices.col(v), force);
    if (!at_left(mesh.vertices.col(v))) {
      EXPECT_EQ(force, Vec2(0, 0));
    }
  }
  EXPECT_LT((sum + Vec2(1, 1 + 17)).norm(), 1e-12) << "forces balance";
  EXPECT_NEAR(moment + (3 * 1 - 0.5 * 1), 0, 1e-11) << "moments balance about the lower left corner";
}

TEST(FieldProblem, KeepsAnalysisAndFactorForAsLongAsTheyAreGood) {
  FieldProblem problem(mesh, 2);
  problem.assemble(elastic);
  clamp_left(problem);
  const auto expect_counts = [&](int n_analyses, int n_factorizations, int n_solves) {
    EXPECT_EQ(problem.n_analyses(), n_analyses);
    EXPECT_EQ(problem.n_factorizations(), n_factorizations);
    EXPECT_EQ(problem.n_solves(), n_solves);
  };
  const int tip = boundary_vertices(mesh, at_right).back();
  problem.add_load(tip, 1, -1);
  const VectorXd first = problem.solve();
  expect_counts(1, 1, 1);

  problem.clear_loads();
  problem.add_load(tip, 1, -2);
  EXPECT_LT((problem.solve() - 2 * first).norm(), 1e-12 * first.norm());
  expect_counts(1, 1, 2);

  problem.hold(boundary_vertices(mesh, at_left)[0], 0, 0.1);  // held before, at another value
  problem.solve();
  expect_counts(1, 1, 3);

  problem.hold(tip, 0);
  problem.solve();
  expect_counts(1, 2, 4);

  problem.assemble(elastic);
  problem.release_all();
  clamp_left(problem);
  problem.clear_loads();
  problem.add_load(tip, 1, -1);
  EXPECT_LT((problem.solve() - first).norm(), 1e-12 * first.norm());
  expect_counts(1, 3, 5);
}

TEST(FieldProblem, GivesTheSameForAnotherSetOfPrescribedDofsAsIfItHadBeenTheFirst) {
  const auto hold_ends = [](FieldProblem& problem) {
    clamp_left(problem);
    for (const int v : boundary_vertices(mesh, at_right)) problem.hold(v, 1, -0.1);
  };
  FieldProblem changed(mesh, 2), fresh(mesh, 2);
  changed.assemble(elastic);
  for (const int v : boundary_vertices(mesh)) changed.hold(v, 0, 0.3);
  for (const int v : boundary_vertices(mesh)) changed.hold(v, 1, 0.2);
  changed.solve();
  changed.release_all();
  hold_ends(changed);
  fresh.assemble(elastic);
  hold_ends(fresh);
  EXPECT_EQ(changed.solve(), fresh.solve());
  EXPECT_EQ(changed.reactions(), fresh.reactions());
}

TEST(FieldProblem, TakesTheLoadsOfCells) {
  FieldProblem problem(mesh, 1);
  problem.assemble([](int, const PointsRef& polygon, MatrixXd& K, VectorXd& f) {
    conduct(polygon, K);
    f.setConstant(signed_area(polygon) / static_cast<double>(polygon.cols()));
  });
  for (const int v : boundary_vertices(mesh)) problem.hold(v, 0);
  problem.solve();
  EXPECT_NEAR(problem.reactions().sum(), -3, 1e-12) << "what flows in, one for each unit of area, flows out";
}

TEST(FieldProblem, NamesAPotentialThatIsHeldNowhere) {
  FieldProblem problem(mesh, 1);
  problem.assemble(conducting);
  problem.add_load(0, 0, 1);
  const std::string message = message_of(problem);
  EXPECT_NE(message.find("vertex 0 at ("), std::string::npos) << message;
  EXPECT_NE(message.find("hold one of its vertices"), std::string::npos) << message;
  problem.hold(0, 0);
  EXPECT_EQ(message_of(problem), "");
}

TEST(FieldProblem, NamesABodyThatIsFreeToMoveOrTurn) {
  struct Hold {
    Vec2 slot;
    int component;
  };
  const auto message_for = [](std::initializer_list<Hold> holds) {
    FieldProblem problem(mesh, 2);
    problem.assemble(elastic);
    for (const auto& [slot, component] : holds) {
      Index v;
      (mesh.vertices.colwise() - slot).colwise().norm().minCoeff(&v);
      problem.hold(static_cast<int>(v), component);
    }
    return message_of(problem);
  };
  const auto names = [](const std::string& message, const char* words) {
    return message.find(words) != std::string::npos;
  };
  EXPECT_TRUE(names(message_for({}), "held too little"));
  EXPECT_TRUE(names(message_for({{{0, 0}, 0}, {{0, 1}, 0}}), "by (")) << "free to move up";
  EXPECT_FALSE(names(message_for({{{0, 0}, 0}, {{0, 1}, 0}}), "while turning"));
  EXPECT_TRUE(names(message_for({{{0, 0}, 0}, {{0, 0}, 1}}), "while turning"));
  EXPECT_TRUE(names(message_for({{{0, 0}, 0}, {{3, 0}, 0}, {{0, 0}, 1}}), "while turning"))
      << "all lines of support meet";
  EXPECT_EQ(message_for({{{0, 0}, 0}, {{0, 1}, 0}, {{0, 0}, 1}}), "");
}

TEST(FieldProblem, NamesThePartThatIsNotHeld) {
  PolygonMesh two = rectangles({0, 0}, {1, 1}, 2, 2);
  const PolygonMesh other = rectangles({5, 0}, {6, 1}, 2, 2);
  const int n = static_cast<int>(two.vertices.cols());
  two.vertices.conservativeResize(2, 2 * n);
  two.vertices.rightCols(n) = other.vertices;
  for (int c = 0; c < other.n_cells(); ++c) {
    std::vector<int> corners(other.cell(c).begin(), other.cell(c).end());
    for (int& v : corners) v += n;
    two.add_cell(corners);
  }
  FieldProblem problem(two, 1);
  problem.assemble(conducting);
  problem.hold(2, 0);
  const std::string message = message_of(problem);
  EXPECT_NE(message.find("vertex 9 at (5, 0) (9 vertices)"), std::string::npos) << message;
  problem.hold(12, 0);
  EXPECT_EQ(message_of(problem), "");
}

TEST(FieldProblem, NamesAVertexOfNoCell) {
  PolygonMesh lonely = rectangles({0, 0}, {1, 1}, 2, 2);
  lonely.vertices.conservativeResize(2, 10);
  lonely.vertices.rightCols(1) << 7, 8;
  FieldProblem problem(lonely, 1);
  problem.assemble(conducting);
  problem.hold(0, 0);
  const std::string message = message_of(problem);
  EXPECT_NE(message.find("vertex 9 at (7, 8) belongs to no cell"), std::string::npos) << message;
}

TEST(FieldProblem, NeedsNoPrescribedDofWhereTheMatrixIsDefiniteByItself) {
  FieldProblem problem(mesh, 1);
  problem.assemble([](int, const PointsRef& polygon, MatrixXd& K, VectorXd& f) {
    conduct(polygon, K);
    f.setConstant(signed_area(polygon) / static_cast<double>(polygon.cols()));
    K.diagonal() += f;  // a lumped mass: -u'' + u = 1 has the solution 1
  });
  EXPECT_LT((problem.solve().array() - 1).abs().maxCoeff(), 1e-12);
}

TEST(FieldProblem, NamesAMatrixThatIsNotPositiveDefinite) {
  FieldProblem problem(mesh, 1);
  problem.assemble([](int, const PointsRef& polygon, MatrixXd& K, VectorXd&) {
    conduct(polygon, K);
    K = -K;
  });
  problem.hold(0, 0);
  const std::string message = message_of(problem);
  EXPECT_NE(message.find("not positive definite"), std::string::npos) << message;
  EXPECT_NE(message.find("vertex "), std::string::npos) << message;
}

TEST(FieldProblem, RefusesAMatrixThatIsNotSymmetric) {
  FieldProblem problem(mesh, 1);
  const auto message_for = [&](double asymmetry) -> std::string {
    try {
      problem.assemble([&](int cell, const PointsRef& polygon, MatrixXd& K, VectorXd&) {
        conduct(polygon, K);
        if (cell == 7) K(2, 0) += asymmetry * K.cwiseAbs().maxCoeff();
      });
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message_for(1e-12), "") << "round-off";
  for (const double asymmetry : {1e-6, -0.1, 100.}) {
    const std::string message = message_for(asymmetry);
    EXPECT_NE(message.find("the matrix of cell 7 is not symmetric: K("), std::string::npos) << message;
    EXPECT_NE(message.find("(2, 0) = "), std::string::npos) << message;
    EXPECT_THROW(problem.solve(), Error) << "what was assembled in part is not solved";
  }
}

TEST(FieldProblem, NamesACellOfNegativeEnergyAndTheCure) {
  FieldProblem problem(mesh, 2);
  problem.assemble([](int cell, const PointsRef& polygon, MatrixXd& K, VectorXd& f) {
    elastic(cell, polygon, K, f);
    if (cell == 41) K = -K;
  });
  clamp_left(problem);
  const std::string message = message_of(problem);
  EXPECT_NE(
      message.find("the matrix of cell 41 has a negative energy: give it a rule without negative weights"),
      std::string::npos)
      << message;
}

/// Four points a triangle, one of negative weight: what they do on notched cells.
TEST(FieldProblem, NamesTheConcaveCellThatHammersFourPointsFailOn) {
  Points cell(2, 6);
  cell << 0, 1, 0.8, 0.4, 0.4, 0.18,  //
      0, 0, 1.65, 0.9, 0.16, 1.89;
  PolygonMesh one;
  one.vertices = cell;
  one.add_cell(std::vector{0, 1, 2, 3, 4, 5});
  const auto message_with = [&](const TriangleRule& rule) {
    FieldProblem problem(one, 2);
    problem.assemble([&](int, const PointsRef& polygon, MatrixXd& K, VectorXd&) {
      TabulatedElement element;
      tabulate(polygon, rule, mean_value, GradientCorrection::on, element);
      stiffness(element, D, K);
    });
    for (const int unknown : {0, 1, 3}) problem.hold(unknown / 2, unknown % 2);
    return message_of(problem);
  };
  const std::string message = message_with(hammer_rule(3));
  EXPECT_NE(message.find("the matrix of cell 0 has a negative energy"), std::string::npos) << message;
  EXPECT_NE(message.find("dunavant_rule"), std::string::npos) << message;
  EXPECT_EQ(message_with(dunavant_rule(3)), "");
}

TEST(FieldProblem, TakesUnusedVerticesThatAreHeld) {
  PolygonMesh lonely = rectangles({0, 0}, {1, 1}, 2, 2);
  lonely.vertices.conservativeResize(2, 10);
  lonely.vertices.rightCols(1) << 7, 8;
  FieldProblem problem(lonely, 2);
  problem.assemble(elastic);
  for (const int v : {0, 2, 9}) problem.hold(v, 0);
  for (const int v : {0, 2}) problem.hold(v, 1);
  EXPECT_NE(message_of(problem).find("not all its unknowns are held"), std::string::npos);
  problem.hold(9, 1, 4);
  EXPECT_EQ(message_of(problem), "");
  EXPECT_EQ(problem.solution()[19], 4);
  EXPECT_EQ(problem.reactions()[19], 0);

  PolygonMesh only_vertices;
  only_vertices.vertices = Points::Random(2, 2);
  FieldProblem trivial(only_vertices, 1);
  trivial.assemble(conducting);
  for (const int v : {0, 1}) trivial.hold(v, 0, v + 1);
  EXPECT_EQ(trivial.solve(), Vec2(1, 2));
}

TEST(FieldProblem, TakesCellsWithoutStiffnessWhereAllIsHeld) {
  FieldProblem problem(mesh, 1);
  problem.assemble([](int, const PointsRef& polygon, MatrixXd& K, VectorXd&) {
    K.setZero(polygon.cols(), polygon.cols());
  });
  for (int v = 0; v < mesh.vertices.cols(); ++v) problem.hold(v, 0, v);
  EXPECT_EQ(problem.solve(), VectorXd::LinSpaced(mesh.vertices.cols(), 0, mesh.vertices.cols() - 1));
  EXPECT_EQ(problem.reactions().norm(), 0);
}

TEST(FieldProblem, KeepsTheReactionsOfTheLastSolution) {
  FieldProblem problem(mesh, 2);
  EXPECT_EQ(problem.reactions(), VectorXd::Zero(problem.n_unknowns()));
  problem.assemble(elastic);
  clamp_left(problem);
  problem.add_load(boundary_vertices(mesh, at_left)[0], 1, 17);
  problem.solve();
  const VectorXd reactions = problem.reactions();
  problem.clear_loads();
  problem.hold(boundary_vertices(mesh, at_right)[0], 0, 1);
  problem.assemble(elastic);
  EXPECT_EQ(problem.reactions(), reactions);
  problem.release_all();
  EXPECT_THROW(problem.solve(), Error);
  EXPECT_EQ(problem.reactions(), reactions);
}

TEST(FieldProblem, IntegratesQuarticEdgeLoadsExactly) {
  const PolygonMesh one = rectangles({0, 0}, {1, 1}, 1, 1);
  FieldProblem problem(one, 1);
  problem.assemble(conducting);
  for (int v = 0; v < 4; ++v) problem.hold(v, 0);
  problem.add_edge_loads(
      boundary_edges(one, [](const Vec2& x) { return x.y() == 0; }),
      [](const Vec2& x, const Vec2&) { return VectorXd::Constant(1, std::pow(x.x(), 4)); });
  problem.solve();
  EXPECT_LT((problem.reactions() - Eigen::Vector4d(-1. / 30, -1. / 6, 0, 0)).norm(), 1e-15);
}

TEST(FieldProblem, TellsNegativeEnergyFromNone) {
  const PolygonMesh one = rectangles({0, 0}, {1, 1}, 1, 1);
  FieldProblem problem(one, 1);
  problem.assemble([](int, const PointsRef&, MatrixXd& K, VectorXd&) { K = -MatrixXd::Identity(4, 4); });
  EXPECT_NE(message_of(problem).find("not positive definite"), std::string::npos);
}

TEST(FieldProblem, NamesTheCellWhoseMatrixCannotBeMade) {
  FieldProblem problem(mesh, 1);
  try {
    problem.assemble([](int cell, const PointsRef& polygon, MatrixXd& K, VectorXd&) {
      if (cell == 5) throw Error("no such material");
      conduct(polygon, K);
    });
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "cell 5: no such material");
  }
}

TEST(FieldProblem, ShowsItsMatrixLoadsAndUnknowns) {
  FieldProblem problem(mesh, 2);
  EXPECT_THROW(problem.matrix(), Error);
  problem.assemble(elastic);
  clamp_left(problem);
  problem.add_edge_loads(boundary_edges(mesh, at_right), pressure(3));
  const VectorXd u = problem.solve(), reactions = problem.reactions();
  const VectorXd forces = problem.matrix().selfadjointView<Eigen::Lower>() * u;
  EXPECT_LT((forces - problem.loads() - reactions).norm(), 1e-12) << "held rows are there as well";
  EXPECT_NEAR(problem.loads().reshaped(2, mesh.vertices.cols()).row(0).sum(), -3, 1e-13);
  const int corner = mesh.cell(4)[2];
  EXPECT_EQ(problem.cell_solution(4)[5], u[problem.unknown(corner, 1)]);
  EXPECT_TRUE(problem.is_prescribed(problem.unknown(boundary_vertices(mesh, at_left)[0], 1)));
  EXPECT_THROW(problem.cell_solution(mesh.n_cells()), Error);
  EXPECT_EQ(problem.solve(), u) << "the matrix taken out is put back";
}

}  // namespace
