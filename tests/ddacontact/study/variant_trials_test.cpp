// Trials of variants of a scene tell what its factor rests on.
#include "rock_on_joints.hpp"

#include <ddacontact/study/variant_trials.hpp>

namespace {

using namespace support;

/// A block of 4 m on a ledge in front of a wall. Its centre is `beyond` the edge of the ledge.
Scene block_on_ledge(double beyond, double poisson) {
  Scene scene = rock({"faces", 40, 0, 0, std::nullopt});
  scene.materials[0].poisson = poisson;
  Points ground(2, 6);
  const double edge = 2 + beyond;
  ground << edge, edge, 19, 19, 4, 4,  //
      0, -10, -10, 4, 4, 0;
  add(scene, ground, true);
  add(scene, rectangle(0, 0, 4, 4));
  scene.blocks[1].model = BlockModel::affine;
  return scene;
}

bool holds(const Scene& scene) {
  return StrengthReduction(scene, {0}).try_factor(1).verdict == Verdict::rests;
}

/// Its heel has nothing that presses it to the wall: it must fall. That it swells holds it there.
TEST(VariantTrials, ABlockHeldByItsSwellingMovesWithoutIt) {
  const Scene beyond = block_on_ledge(0.1, 0.25), within = block_on_ledge(-0.1, 0.25);
  ASSERT_TRUE(holds(beyond)) << "nothing to warn of";
  const auto found = try_without_swelling(beyond, {0}, 1);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->verdict, Verdict::moves);
  EXPECT_EQ(found->factor, 0.95);
  EXPECT_EQ(try_without_swelling(within, {0}, 1).value().verdict, Verdict::rests);
}

TEST(VariantTrials, OneWithoutSwellingIsNotTriedAgain) {
  EXPECT_FALSE(try_without_swelling(block_on_ledge(0.1, 0), {0}, 1));
  EXPECT_FALSE(holds(block_on_ledge(0.1, 0)));
}

}  // namespace
