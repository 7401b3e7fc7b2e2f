#include <tests/support/random_shapes.hpp>

#include <ddacontact/block/stress_moments.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/material/linear_elastic.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <gtest/gtest.h>

using namespace ddacontact;

namespace {

struct LinearStress {
  Vec3 mean = Vec3::Random();
  StressMoments gradient = StressMoments::Random();

  Vec3 at(const Vec2& x) const { return mean + gradient * x; }
  Vec2 traction(const Vec2& x, const Vec2& n) const {
    const Vec3 s = at(x);
    return {s[0] * n.x() + s[2] * n.y(), s[2] * n.x() + s[1] * n.y()};
  }
  Vec2 divergence() const { return {gradient(0, 0) + gradient(2, 1), gradient(2, 0) + gradient(1, 1)}; }
};

/// Any linear stress is in equilibrium with its tractions and a uniform body force.
TEST(StressMoments, ForcesTellThemAsTheStressHasThem) {
  std::mt19937 random(3);
  for (int k = 0; k < 50; ++k) {
    const Points outline = support::random_shape(random);
    const Points local = outline.colwise() - polyfem::area_moments(outline).centroid;
    const LinearStress stress;
    std::vector<ActingForce> forces;
    const polyfem::GaussRule gauss = polyfem::gauss_rule(3);
    for (Index e = 0; e < local.cols(); ++e) {
      const Vec2 from = local.col(e), edge = local.col((e + 1) % local.cols()) - from;
      const Vec2 n(edge.y(), -edge.x());  // times the length
      for (Index q = 0; q < gauss.points.size(); ++q) {
        const Vec2 x = from + gauss.points[q] * edge;
        forces.push_back({x, gauss.weights[q] * stress.traction(x, n)});
      }
    }
    polyfem::PolygonRule rule;
    polyfem::make_polygon_rule(local, polyfem::hammer_rule(5), rule);
    Tensors at_points(3, rule.points.cols());
    for (Index q = 0; q < rule.points.cols(); ++q) at_points.col(q) = stress.at(rule.points.col(q));
    const StressMoments expected = moments_of_stresses(rule, at_points);
    EXPECT_LE((moments_of_forces(rule, forces, -stress.divergence()) - expected).norm(),
              1e-11 * (1 + expected.norm()));

    // A resultant goes into accelerating the block: a uniform body force is none.
    for (ActingForce& acting : forces) acting.force.setZero();
    EXPECT_LE(moments_of_forces(rule, forces, {3, -7}).norm(), 1e-12);

    const Mat3 C = polyfem::elasticity_matrix(2, 0.3, polyfem::Plane::strain).inverse();
    double energy = 0;
    for (Index q = 0; q < rule.points.cols(); ++q) {
      const Vec3 s = stress.gradient * rule.points.col(q);
      energy += rule.weights[q] * s.dot(C * s) / 2;
    }
    EXPECT_NEAR(energy_of_moments(rule, C, expected), energy, 1e-11 * energy);
  }
}

/// A rectangle turned by any angle under a moment M: M^2 L / (2 E' I); pulled along its length by its weight:
/// none.
TEST(StressMoments, BendingIsAxialStressLinearAcross) {
  for (double angle : {0., 0.3, 1.2, 2.9}) {
    const Eigen::Rotation2Dd turn(angle);
    Points bar(2, 4);
    bar << -3, 3, 3, -3, -0.5, -0.5, 0.5, 0.5;
    bar = (turn.toRotationMatrix() * bar).eval();
    polyfem::PolygonRule rule;
    polyfem::make_polygon_rule(bar, polyfem::hammer_rule(5), rule);
    const Vec2 along = turn * Vec2(1, 0), across = turn * Vec2(0, 1);
    const auto at = [&](double x, double y) { return Vec2(x * along + y * across); };
    const std::vector<ActingForce> moments{{at(3, 0.5), -2 * along},
                                           {at(3, -0.5), 2 * along},
                                           {at(-3, 0.5), 2 * along},
                                           {at(-3, -0.5), -2 * along}};
    const Mat3 C = polyfem::elasticity_matrix(7, 0.3, polyfem::Plane::strain).inverse();
    const double E = 7 / 0.91, expected = 2 * 2 * 6 / (2 * E / 12);
    EXPECT_NEAR(energy_of_bending(rule, C, moments_of_forces(rule, moments, {0, 0})), expected, 1e-11);
    const std::vector<ActingForce> hanging{{at(3, 0), 12 * along}};
    EXPECT_NEAR(energy_of_bending(rule, C, moments_of_forces(rule, hanging, -2 * along)), 0, 1e-11);
  }
}

}  // namespace
