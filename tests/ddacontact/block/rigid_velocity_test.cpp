#include <tests/ddacontact/simple_scenes.hpp>
#include <tests/support/concave_polygons.hpp>

#include <gtest/gtest.h>

using namespace support;

/// Of velocities linear in the place: momentum over mass, angular momentum over inertia by the outline's
/// moments.
TEST(RigidVelocity, IsThatOfTheMomentaWhateverTheStrainRate) {
  Scene scene = rock_scene(0.1, 1);
  const Points outline = points({{1e3, 5}, {1e3 + 3, 5}, {1e3 + 2, 7}, {1e3, 6}});
  scene.blocks = {block(rectangle(0, 0, 1, 1)), block(outline)};
  const BuiltScene built = build(scene);
  const Block& second = built.stepper->blocks().block(1);
  const polyfem::AreaMoments of = polyfem::area_moments(outline);
  const Vec2 mean(3, -2);
  Mat2 G;
  G << 0.5, -1, 2, -0.25;
  VectorXd velocity = VectorXd::Constant(built.stepper->blocks().n_unknowns(), 7);
  for (int v = 0; v < 4; ++v)
    velocity.segment<2>(second.unknowns().first + 2 * v) = mean + G * (outline.col(v) - of.centroid);
  const RigidVelocity rigid = rigid_velocity(second, built.stepper->state(), velocity);
  EXPECT_LE((rigid.linear - mean).norm(), 1e-11);
  const Mat2 I = G * of.second;  // integral of velocity times place
  EXPECT_NEAR(rigid.angular, (I(1, 0) - I(0, 1)) / of.second.trace(), 1e-11);
  EXPECT_NEAR(rigid_velocity(built.stepper->blocks().block(0), built.stepper->state(), velocity).angular, 0,
              1e-14);
}
