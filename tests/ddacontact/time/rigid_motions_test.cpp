#include <ddacontact/time/rigid_motions.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <gtest/gtest.h>

#include <array>

using namespace support;

namespace {

/// A free block, one that turns about a vertex, one on a roller, one that is held.
BuiltScene supported_blocks() {
  Scene scene = rock_scene(0.1, 1);
  scene.blocks = {block(rectangle(0, 0, 2, 1)), block(rectangle(3, 0, 1, 1)), block(rectangle(6, 0, 1, 4)),
                  block(rectangle(9, 0, 1, 1), true)};
  for (int b : {0, 1})
    scene.blocks[static_cast<std::size_t>(b)].vertices =
        turned(scene.blocks[static_cast<std::size_t>(b)].vertices, 0.3);
  scene.blocks[0].model = BlockModel::affine;
  scene.supports = {{1, {2}, true, true, {}}, {2, {0}, false, true, {}}};
  return build(scene);
}

double kinetic(const BlockSystem& blocks, const VectorXd& u, const VectorXd& v) {
  double sum = 0;
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    const Range& of = blocks.block(b).unknowns();
    sum +=
        u.segment(of.first, of.count).dot(blocks.block(b).times_mass(v.segment(of.first, of.count)).col(0)) /
        2;
  }
  return sum;
}

constexpr std::array all_four{0, 1, 2, 3};

}  // namespace

TEST(RigidMotions, AreThoseThatSupportsAllowWithTheEnergyOfTheirCoefficients) {
  const BuiltScene built = supported_blocks();
  const BlockSystem& blocks = built.stepper->blocks();
  const RigidMotions motions(blocks, built.stepper->state(), all_four);
  ASSERT_EQ(motions.n_coefficients(), 3 + 1 + 2);
  EXPECT_EQ(motions.largest_mass(), 2000 * 4);
  const VectorXd q = VectorXd::LinSpaced(6, -1, 2);
  VectorXd v = VectorXd::Zero(blocks.n_unknowns());
  motions.add_motion(q, v);
  EXPECT_NEAR(kinetic(blocks, v, v), q.squaredNorm() / 2, 1e-12);
  EXPECT_LE((motions.coefficients(v) - q).norm(), 1e-12);
  for (int u = 0; u < v.size(); ++u)
    EXPECT_TRUE(v[u] == 0 || blocks.equation()[static_cast<std::size_t>(u)] >= 0);
  for (int b = 0; b < 3; ++b) {  // distances stay
    const Block& of = blocks.block(b);
    for (int k = 0; k < 4; ++k)
      for (int l = 0; l < k; ++l)
        EXPECT_NEAR(
            (of.reference().col(k) - of.reference().col(l)).dot(of.vertex_map(k)(v) - of.vertex_map(l)(v)), 0,
            1e-12);
  }
  motions.add_motion(-q, v);
  EXPECT_LE(v.norm(), 1e-14);
}

TEST(RigidMotions, WhatIsLeftOfAVelocityIsOrthogonalToThem) {
  const BuiltScene built = supported_blocks();
  const BlockSystem& blocks = built.stepper->blocks();
  const RigidMotions motions(blocks, built.stepper->state(), std::array{0, 1});
  VectorXd left = VectorXd::LinSpaced(blocks.n_unknowns(), -2, 3).array().square();
  for (int u = 0; u < left.size(); ++u)
    if (blocks.equation()[static_cast<std::size_t>(u)] < 0) left[u] = 0;
  const VectorXd velocity = left;
  motions.add_motion(-motions.coefficients(velocity), left);
  EXPECT_LE(motions.coefficients(left).norm(), 1e-11);
  const Range& other = blocks.block(2).unknowns();
  EXPECT_EQ(left.segment(other.first, other.count), velocity.segment(other.first, other.count));
}

TEST(RigidMotions, RatesOfFormsAreThoseOfTheirMotions) {
  const BuiltScene built = supported_blocks();
  const BlockSystem& blocks = built.stepper->blocks();
  const RigidMotions motions(blocks, built.stepper->state(), all_four);
  AffineForm form;
  form.constant = 7;
  blocks.block(1).vertex_map(0).add_to(form, {0.3, -1});
  blocks.block(3).vertex_map(1).add_to(form, {1, 1});
  blocks.block(2).vertex_map(0).add_to(form, {2, 5});
  const AffineForm rate = motions.rate_form(form);
  EXPECT_EQ(rate.constant, 0);
  const VectorXd q = VectorXd::LinSpaced(6, -1, 2);
  VectorXd v = VectorXd::Zero(blocks.n_unknowns());
  motions.add_motion(q, v);
  EXPECT_NEAR(rate.change(q), form.change(v), 1e-13);
  // A held place and the distance of two places of a block: exactly 0.
  AffineForm at_hinge, distance;
  blocks.block(1).vertex_map(2).add_to(at_hinge, {0.3, -1});
  const Vec2 along = blocks.block(0).reference().col(2) - blocks.block(0).reference().col(0);
  blocks.block(0).vertex_map(2).add_to(distance, along);
  blocks.block(0).vertex_map(0).add_to(distance, -along);
  for (const AffineForm& still : {at_hinge, distance})
    for (const double c : motions.rate_form(still).coefficients()) EXPECT_EQ(c, 0);
}
