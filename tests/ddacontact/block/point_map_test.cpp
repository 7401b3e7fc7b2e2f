#include <ddacontact/block/point_map.hpp>

#include <gtest/gtest.h>

using namespace ddacontact;

TEST(PointMap, MergesColumnsOfOneUnknown) {
  PointMap map;
  for (int k = 0; k < 3 * PointMap::capacity; ++k) map.add(k % PointMap::capacity, Vec2(k, 1));
  const VectorXd d = VectorXd::Unit(PointMap::capacity, 2);
  EXPECT_EQ(map(d), Vec2(2 + 8 + 14, 3));
}

/// The work of a force is the same told by the point's displacement or by the unknowns.
TEST(PointMap, ForcesAreTheTransposeOfDisplacements) {
  PointMap map;
  for (int k = 0; k < PointMap::capacity; ++k) map.add(2 * k, Vec2::Random());
  for (int trial = 0; trial < 20; ++trial) {
    const VectorXd d = VectorXd::Random(12);
    const Vec2 force = Vec2::Random();
    VectorXd F = VectorXd::Zero(12);
    map.add_force(force, F);
    EXPECT_NEAR(F.dot(d), force.dot(map(d)), 1e-14);
    AffineForm form;
    map.add_to(form, force);
    EXPECT_NEAR(form.change(d), force.dot(map(d)), 1e-14);
  }
}
