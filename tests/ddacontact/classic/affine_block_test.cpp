#include <ddacontact/block/block_system.hpp>
#include <ddacontact/classic/affine_block.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

using namespace ddacontact;

namespace {

const BlockMaterial material{polyfem::elasticity_matrix(7e6, 0.2, polyfem::Plane::strain), 1500};

struct AffineBlockAtRest {
  BlockSystem system;
  BlockState state;

  explicit AffineBlockAtRest(const Points& outline, const std::optional<ControlVertices>& control = {})
      : system(only(outline, control)), state(system.initial_state()) {
    system.reshape(state, true);
  }
  static std::vector<std::unique_ptr<Block>> only(const Points& outline,
                                                  const std::optional<ControlVertices>& control) {
    std::vector<std::unique_ptr<Block>> blocks;
    blocks.push_back(std::make_unique<AffineBlock>(material, outline, control));
    return blocks;
  }
  const AffineBlock& block() const { return static_cast<const AffineBlock&>(system.block(0)); }
};

/// 4 m x 2 m about (10, 5).
Points wide_rectangle() {
  Points outline(2, 4);
  outline << 8, 12, 12, 8,  //
      4, 4, 6, 6;
  return outline;
}

using Unknowns = Eigen::Matrix<double, 6, 1>;

}  // namespace

/// (u0, v0, r0, eps_x, eps_y, gamma_xy) of Shi at a corner 2 m to the right of the centroid and 1 m above.
TEST(AffineBlock, UnknownsAreTranslationRotationAndStrain) {
  const AffineBlockAtRest one(wide_rectangle());
  const PointMap corner = one.block().vertex_map(2);
  const std::vector<Vec2> expected{{1, 0}, {0, 1}, {-1, 2}, {2, 0}, {0, 1}, {0.5, 1}};
  for (int k = 0; k < 6; ++k)
    EXPECT_LE((corner(VectorXd::Unit(6, k)) - expected[static_cast<std::size_t>(k)]).norm(), 1e-13) << k;
  EXPECT_EQ(one.block().unknown_lengths().head<2>(), Vec2(1, 1));
  EXPECT_TRUE((one.block().unknown_lengths().tail<4>().array() == one.block().size()).all());
}

/// Of a rectangle a x b: moments of inertia m a^2 / 12 and m b^2 / 12.
TEST(AffineBlock, MassAndStiffnessAreThoseOfARectangle) {
  const AffineBlockAtRest one(wide_rectangle());
  const double m = 1500 * 8, x = m * 16 / 12, y = m * 4 / 12;
  MatrixXd M = MatrixXd::Zero(6, 6);
  M.diagonal() << m, m, x + y, x, y, (x + y) / 4;
  M(2, 5) = M(5, 2) = (x - y) / 2;
  EXPECT_LE((one.block().mass() - M).norm(), 1e-10 * m);
  MatrixXd K = MatrixXd::Zero(6, 6);
  K.bottomRightCorner<3, 3>() = 8 * material.elasticity;
  EXPECT_LE((one.block().stiffness() - K).norm(), 1e-10 * K.norm());
  VectorXd F = VectorXd::Zero(6);
  one.block().add_body_force({3, -7}, F);
  EXPECT_LE((F - (Unknowns() << 24, -56, 0, 0, 0, 0).finished()).norm(), 1e-12);
  BlockState stressed = one.state;
  stressed.stress.col(0) << 1, 2, 3;
  F.setZero();
  one.block().add_stress_forces(stressed, F);
  EXPECT_LE((F - (Unknowns() << 0, 0, 0, -8, -16, -24).finished()).norm(), 1e-12);
}

TEST(AffineBlock, UnknownsOfControlVerticesAreTheirDisplacements) {
  const ControlVertices control{{2, 0, 1}, {3, 2, 0}};
  const AffineBlockAtRest one(wide_rectangle(), control);
  const VectorXd d = VectorXd::LinSpaced(6, -1, 2);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(one.block().vertex_map(control.x[static_cast<std::size_t>(k)])(d).x(), d[2 * k], 1e-13);
    EXPECT_NEAR(one.block().vertex_map(control.y[static_cast<std::size_t>(k)])(d).y(), d[2 * k + 1], 1e-13);
  }
  EXPECT_EQ(one.block().unknown_lengths(), VectorXd::Ones(6));
}
