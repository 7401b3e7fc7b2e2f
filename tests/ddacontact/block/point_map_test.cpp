#include <ddacontact/block/point_map.hpp>

#include <gtest/gtest.h>

using namespace ddacontact;

namespace {

std::vector<PointMap::Term> random_terms() {
  std::vector<PointMap::Term> terms;
  for (int k = 0; k < PointMap::capacity; ++k) terms.push_back({2 * k, Vec2::Random()});
  return terms;
}

}  // namespace

TEST(PointMap, MergesColumnsOfOneUnknown) {
  std::vector<PointMap::Term> terms;
  for (int k = 0; k < 3 * PointMap::capacity; ++k) add_term(k % PointMap::capacity, Vec2(k, 1), terms);
  const VectorXd d = VectorXd::Unit(PointMap::capacity + 4, 6);
  EXPECT_EQ(PointMap(4, terms)(d), Vec2(2 + 8 + 14, 3));
}

/// The work of a force is the same told by the point's displacement or by the unknowns.
TEST(PointMap, ForcesAreTheTransposeOfDisplacements) {
  const auto terms = random_terms();
  for (const PointMap& map : {PointMap(0, terms), PointMap(3), PointMap()}) {
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
}
