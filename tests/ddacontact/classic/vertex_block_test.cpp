// Stress inside a block as the strain of vertex displacements.

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/classic/vertex_block.hpp>
#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/quadrature/triangle_rule.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

using namespace ddacontact;
using polyfem::GradientCorrection;
using support::uniform;

namespace {

const Mat3 elasticity = polyfem::elasticity_matrix(7e6, 0.2, polyfem::Plane::strain);
const polyfem::TriangleRule& rule = polyfem::hammer_rule(3);

/// One vertex block and its integration points, seen from the block's origin.
struct VertexBlockAtRest {
  BlockSystem system;
  BlockState state;
  polyfem::TabulatedElement element;

  VertexBlockAtRest(const Points& outline, GradientCorrection correction)
      : system(blocks_of(outline, correction)), state(system.initial_state()) {
    system.reshape(state, true);
    polyfem::tabulate(state.position, rule, polyfem::wachspress, correction, element);
  }
  const IncrementalBlock& block() const { return static_cast<const IncrementalBlock&>(system.block(0)); }
  Index n_points() const { return element.rule.points.cols(); }
  /// Of the vertex displacements that stand for the stress, at a point.
  Vec3 stress(const Points& w, const Vec2& x) const {
    polyfem::ShapeValues shape;
    polyfem::wachspress(state.position, x, shape);
    const Mat2 gradient = w * shape.gradients.transpose();
    return elasticity * Vec3(gradient(0, 0), gradient(1, 1), gradient(0, 1) + gradient(1, 0));
  }

 private:
  static std::vector<std::unique_ptr<Block>> blocks_of(const Points& outline, GradientCorrection correction) {
    std::vector<std::unique_ptr<Block>> blocks;
    blocks.push_back(std::make_unique<VertexBlock>(BlockMaterial{elasticity, 1500}, outline,
                                                   Integration{&rule, correction}));
    return blocks;
  }
};

class StrainDisplacement : public testing::TestWithParam<GradientCorrection> {
 protected:
  std::mt19937 random{23};

  template <class Check>
  void for_each_block(const Check& check) {
    for (int n = 3; n <= 9; ++n) {
      SCOPED_TRACE(testing::Message() << n << " vertices");
      check(VertexBlockAtRest(2 * support::random_convex_polygon(n, random), GetParam()));
    }
  }
  VectorXd random_numbers(Index n) {
    return VectorXd::NullaryExpr(n, [&] { return uniform(-1, 1, random); });
  }
};

INSTANTIATE_TEST_SUITE_P(, StrainDisplacement,
                         testing::Values(GradientCorrection::on, GradientCorrection::off),
                         [](const auto& p) { return p.param == GradientCorrection::on ? "on" : "off"; });

/// The stress of a block that has deformed is found again at its integration points.
TEST_P(StrainDisplacement, IsTheDeformationItselfWhileTheBlockHasNotTurned) {
  for_each_block([&](VertexBlockAtRest one) {
    one.block().add_stress(1e-3 * random_numbers(one.block().n_unknowns()), one.state.stress);
    const Points w = one.block().strain_displacement(one.state);
    const double scale = one.state.stress.norm();
    for (Index q = 0; q < one.n_points(); ++q)
      EXPECT_LE((one.stress(w, one.element.rule.points.col(q)) - one.state.stress.col(q)).norm(),
                1e-10 * scale);
  });
}

/// Any stresses at the integration points, such as those of a block that has turned, keep their mean.
TEST_P(StrainDisplacement, KeepsTheMeanOfAnyStress) {
  for_each_block([&](VertexBlockAtRest one) {
    for (Index q = 0; q < one.n_points(); ++q) one.state.stress.col(q) = 1e4 * random_numbers(3);
    const Points w = one.block().strain_displacement(one.state);
    const VectorXd& weights = one.block().integration_weights();
    Vec3 mean = Vec3::Zero(), expected = Vec3::Zero();
    for (Index q = 0; q < one.n_points(); ++q) {
      mean += weights[q] * one.stress(w, one.element.rule.points.col(q));
      expected += weights[q] * one.state.stress.col(q);
    }
    EXPECT_LE((mean - expected).norm(), 1e-9 * 1e4 * weights.sum());
  });
}

/// u = (x y, 0) about the centre, what bending is to this element: sxx follows y, and a shear follows x.
TEST_P(StrainDisplacement, OfARectangleInBendingIsLinear) {
  Points outline(2, 4);
  outline << 1, 5, 5, 1,  //
      2, 2, 3, 3;
  VertexBlockAtRest one(outline, GetParam());
  const Vec2 centre(3, 2.5);
  VectorXd d = VectorXd::Zero(8);
  for (int v = 0; v < 4; ++v) {
    const Vec2 r = outline.col(v) - centre;
    d[2 * v] = 1e-3 * r.x() * r.y();
  }
  one.block().add_stress(d, one.state.stress);
  const Points w = one.block().strain_displacement(one.state);
  for (int k = 0; k < 50; ++k) {
    const Vec2 r(uniform(-2, 2, random), uniform(-0.5, 0.5, random));
    const Vec3 expected = 1e-3 * elasticity * Vec3(r.y(), 0, r.x());
    EXPECT_LE((one.stress(w, centre - one.state.origin.col(0) + r) - expected).norm(),
              1e-10 * 1e-3 * elasticity.norm());
  }
}

TEST_P(StrainDisplacement, UsesMeanValueFunctionsWhileACornerIsConcave) {
  Points outline(2, 4);
  outline << 0, 2, 2, 0,  //
      0, 0, 2, 2;
  VertexBlockAtRest one(outline, GetParam());
  EXPECT_EQ(one.block().n_stress_points(), 4 * rule.weights.size());
  EXPECT_EQ(one.block().vertex_map(3).first_unknown(), 6);
  EXPECT_EQ(one.block().cell(0).basis, &polyfem::wachspress);
  const Vec2 shift = Vec2(0.6, 0.6) - outline.col(2);
  one.state.position.col(2) += shift;
  one.system.reshape(one.state);
  EXPECT_EQ(one.block().cell(0).basis, &polyfem::wachspress) << "which come back";
  const MatrixXd K = one.block().stiffness();
  EXPECT_LE((K * one.block().rigid_modes(one.state)).norm(), 1e-11 * K.norm());
  const auto& shifts = one.block().translations();
  EXPECT_NEAR(shifts.col(0).dot(one.block().mass() * shifts.col(0)), 1500 * 4, 1e-9) << "no mass is lost";
  const VertexBlock other({elasticity, 1500}, outline, {&rule, GetParam()}, polyfem::mean_value);
  EXPECT_EQ(other.cell(0).basis, &polyfem::mean_value);
  VectorXd F = VectorXd::Zero(8);
  one.block().add_body_force({0, -2}, F);
  EXPECT_NEAR(one.block().translations().col(1).dot(F), -2 * 4, 1e-12);
  EXPECT_NEAR(one.block().rotation(one.state).dot(F), 0, 1e-12);
}

}  // namespace
