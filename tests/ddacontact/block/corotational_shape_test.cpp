#include <ddacontact/block/corotational_shape.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/quadrature/triangle_rule.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <gtest/gtest.h>

#include <unsupported/Eigen/KroneckerProduct>

using namespace support;

namespace {

BlockMaterial elastic_rock(double poisson = 0.25) {
  return {polyfem::elasticity_matrix(8e9, poisson, polyfem::Plane::strain), 2500};
}

std::vector<CorotationalShape> shapes_of(const Points& outline) {
  std::vector<CorotationalShape> all;
  all.push_back(polygon_shape(elastic_rock(), outline, polyfem::suitable_basis(outline),
                              {&polyfem::hammer_rule(3), polyfem::GradientCorrection::on}));
  all.push_back(affine_shape(elastic_rock(), outline));
  all.push_back(affine_shape(elastic_rock(), outline, ControlVertices{{2, 0, 1}, {0, 3, 2}}));
  for (const bool edge_nodes : {true, false})
    all.push_back(mesh_shape(elastic_rock(), divide(outline, {CellKind::voronoi, 10, 0, edge_nodes}),
                             polyfem::GradientCorrection::on));
  return all;
}

}  // namespace

/// A shift moves every vertex by itself and meets the mass alone, of the weight of the outline.
TEST(CorotationalShape, AShiftMeetsTheMassAlone) {
  const Points outline = turned(rectangle(3, 1, 2, 1), 0.4);
  const StepRule rule{.scheme = Scheme::newmark, .damping = {.mass = 3, .stiffness = 1e-3}};
  for (const CorotationalShape& shape : shapes_of(outline)) {
    EXPECT_NEAR(shape.mass_total, 2 * 2500, 1e-8);
    EXPECT_NEAR(shape.integration_weights.sum(), 2, 1e-12);
    const double dt = 1e-3;
    const auto matrices = step_matrices(shape, rule, dt);
    VectorXd sum = VectorXd::Zero(2 * shape.nodes.cols());
    for (std::size_t c = 0; c < shape.cells.size(); ++c) {
      const ShapeCell& cell = shape.cells[c];
      const auto n = static_cast<int>(cell.mass.rows());
      for (int a = 0; a < n; ++a)
        for (int b = 0; b < n; ++b) {
          const int to = cell.nodes.empty() ? a : cell.nodes[static_cast<std::size_t>(a)],
                    from = cell.nodes.empty() ? b : cell.nodes[static_cast<std::size_t>(b)];
          sum.segment<2>(2 * to) +=
              matrices->tangents[c].block<2, 2>(2 * a, 2 * b) * Vec2(shape.translation[from], 0);
        }
    }
    const double expected = (rule.inertia() / (dt * dt) + 3 / dt) * 2 * 2500;
    double work = 0;
    for (Index a = 0; a < shape.nodes.cols(); ++a) work += shape.translation[a] * sum[2 * a];
    EXPECT_NEAR(work, expected, 1e-9 * expected);
  }
}

/// Changes of the nodes by the unknowns and back; unknowns of control vertices are their displacements.
TEST(CorotationalShape, UnknownsAndNodesTellEachOther) {
  const Points outline = rectangle(3, 1, 2, 1);
  for (const CorotationalShape& shape : shapes_of(outline)) {
    EXPECT_EQ(shape.translations.rows(), shape.n_unknowns());
    if (!shape.has_basis()) continue;
    const MatrixXd there_and_back = MatrixXd(shape.inverse_basis) * MatrixXd(shape.basis);
    EXPECT_LE((there_and_back - MatrixXd::Identity(shape.n_unknowns(), shape.n_unknowns())).norm(), 1e-13);
    // Linear fields come back, with points on straight edges as well.
    const VectorXd back = shape.basis * (shape.inverse_basis * shape.nodes.reshaped());
    EXPECT_LE((back - shape.nodes.reshaped()).norm(), 1e-13);
    for (int axis = 0; axis < 2; ++axis)  // a shift by 1 moves all of the unknowns along the axis by 1
      for (Index u = 0; u < shape.n_unknowns(); ++u)
        EXPECT_NEAR(shape.translations(u, axis), u % 2 == axis, 1e-13);
    for (const ShapeCell& cell : shape.cells) {
      const MatrixXd basis(shape.basis);
      for (Index k = 0; k < cell.nodes_by_unknowns.rows(); ++k) {
        const int node =
            cell.nodes.empty() ? static_cast<int>(k / 2) : cell.nodes[static_cast<std::size_t>(k / 2)];
        const VectorXd row = basis(2 * node + k % 2, cell.unknowns);
        EXPECT_LE((cell.nodes_by_unknowns.row(k).transpose() - row).norm(), 1e-14);
      }
    }
  }
}

/// A square of uniform strain vibrates at sqrt(12 (D11 + D12) / density) / side, when it swells.
TEST(CorotationalShape, FrequenciesAndStableStepsOfAnAffineSquare) {
  const double side = 0.5;
  const CorotationalShape shape = affine_shape(elastic_rock(), rectangle(-3, 7, side, side));
  const Mat3& D = elastic_rock().elasticity;
  const double w = std::sqrt(12 * (D(0, 0) + D(0, 1)) / 2500) / side;
  EXPECT_NEAR(shape.highest_frequency(), w, 1e-9 * w);
  EXPECT_NEAR(critical_step(shape, {}) * w, 2, 1e-9);
  const RayleighDamping damping{.mass = 0, .stiffness = 2 * 0.75 / w};  // 3/4 of critical
  EXPECT_NEAR(critical_step(shape, damping) * w, 2 * (std::sqrt(1 + 0.75 * 0.75) - 0.75), 1e-9);
  EXPECT_NEAR(longest_explicit_step(shape, damping), 0.9 * critical_step(shape, damping), 1e-15);
}

/// Explicit steps have no stiffness in their matrices, those of the middle half of it.
TEST(CorotationalShape, StiffnessOfAStepIsThatOfTheShareOfItsEnd) {
  const CorotationalShape shape = affine_shape(elastic_rock(), rectangle(0, 0, 2, 1));
  const MatrixXd& K = shape.cells[0].elastic.stiffness();
  const auto less_inertia = [&](Scheme scheme, const RayleighDamping& damping) -> MatrixXd {
    const StepRule rule{.scheme = scheme, .damping = damping};
    const double dt = 1e-2;
    return step_matrices(shape, rule, dt)->tangents[0] -
           rule.inertia() / (dt * dt) *
               MatrixXd(Eigen::kroneckerProduct(shape.cells[0].mass, Mat2::Identity()));
  };
  EXPECT_LE((less_inertia(Scheme::newmark, {}) - K).norm(), 1e-12 * K.norm());
  EXPECT_LE((less_inertia(Scheme::midpoint, {}) - K / 2).norm(), 1e-12 * K.norm());
  EXPECT_LE((less_inertia(Scheme::newmark, {0, 0.02}) - 3 * K).norm(), 1e-12 * K.norm());
  EXPECT_LE(less_inertia(Scheme::central_difference, {}).norm(), 1e-12 * K.norm());
}

TEST(CorotationalShape, OnlyNearlyIncompressibleMeshesHaveAMeanDilatation) {
  const BlockMesh mesh = divide(rectangle(0, 0, 1, 1), {CellKind::voronoi, 6, 0, true});
  for (const double poisson : {0.3, 0.449, 0.451, 0.49})
    for (const ShapeCell& cell :
         mesh_shape(elastic_rock(poisson), mesh, polyfem::GradientCorrection::on).cells)
      EXPECT_EQ(cell.mean_dilatation, poisson > 0.45);
}
