#include <ddacontact/block/water_pressure.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <tests/support/concave_polygons.hpp>

#include <gtest/gtest.h>

using namespace ddacontact;
using support::points;

TEST(WaterPressure, OfAnyPolygonUnderWaterIsTheWeightOfItsVolume) {
  const Points polygon = points({{0, 0}, {3, -1}, {4, 2}, {1.5, 1}, {-1, 3}});
  for (const Points& table : {points({{0, 9}}), points({{-2, 8}, {1, 8}, {6, 8}})}) {
    Vec2 sum = Vec2::Zero();
    double moment = 0;
    for (Index k = 0; k < polygon.cols(); ++k) {
      const Vec2 start = polygon.col(k), end = polygon.col((k + 1) % polygon.cols());
      // Parts of an edge add up to it.
      for (const auto& [from, to] : {std::pair{0.0, 0.3}, {0.3, 1.0}}) {
        const EdgeForces forces = water_forces(table, 10, start, end, from, to);
        sum += forces.start + forces.end;
        moment += cross(start, forces.start) + cross(end, forces.end);
      }
    }
    const polyfem::AreaMoments moments = polyfem::area_moments(polygon);
    EXPECT_NEAR((sum - Vec2(0, 10 * moments.area)).norm(), 0, 1e-11);
    EXPECT_NEAR(moment, 10 * moments.area * moments.centroid.x(), 1e-11);
  }
}

TEST(WaterPressure, AboveTheTableThereIsNone) {
  const Points table = points({{0, 1}, {2, 0}});
  const auto on_wall = [&](double x, double low, double high) {
    return water_forces(table, 10, {x, high}, {x, low}, 0, 1);
  };
  EXPECT_EQ(on_wall(0.5, 1, 2).start, Vec2(0, 0));
  const EdgeForces half = on_wall(1, -1, 2);  // wet from -1 to .5
  EXPECT_NEAR((half.start + half.end).x(), 10 * 1.5 * 1.5 / 2, 1e-12);
  EXPECT_NEAR(half.start.x() * 3, 10 * 1.5 * 1.5 / 2 * 0.5, 1e-12);  // its centre is .5 m above the foot
  // Beyond the ends the table is level.
  EXPECT_NEAR((on_wall(-5, 0, 1).start + on_wall(-5, 0, 1).end).x(), 5, 1e-12);
  EXPECT_EQ(on_wall(7, 0, 1).end, Vec2(0, 0));
}

/// At a depth of 2 m at its start and of 5 m at its end, N per m of an edge of 3 m: ends take what a beam's
/// do.
TEST(WaterPressure, IsSharedByTheEndsOfTheEdge) {
  const EdgeForces forces = water_forces(points({{0, 0}}), 10, {0, -2}, {0, -5}, 0, 1);
  EXPECT_NEAR(forces.start.x(), 3. * (2 * 20 + 50) / 6, 1e-12);
  EXPECT_NEAR(forces.end.x(), 3. * (20 + 2 * 50) / 6, 1e-12);
  EXPECT_EQ(forces.start.y(), 0);
  // Upwards from below, on either side of a point of the table, to where the edge is dry.
  const EdgeForces below = water_forces(points({{0, 0}, {1, 2}, {3, 0}}), 10, {0, 0}, {4, 0}, 0, 1);
  EXPECT_NEAR((below.start + below.end).y(), 10 * (1 + 2), 1e-12);
  EXPECT_NEAR(below.end.y(), 10 * (1 * 2. / 3 + 2 * 5. / 3) / 4, 1e-12);
}
