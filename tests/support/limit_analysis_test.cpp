// Limits of rigid blocks with known answers.
#include "limit_analysis.hpp"
#include "polygons.hpp"
#include "random_arches_walls.hpp"
#include "random_slopes.hpp"
#include "rigid_rock.hpp"
#include "scene_changes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace support;
using ddacontact::Load;

namespace {

constexpr double degree = std::numbers::pi / 180;

Points polygon(const std::vector<Vec2>& corners) {
  Points outline(2, static_cast<Eigen::Index>(corners.size()));
  for (std::size_t k = 0; k < corners.size(); ++k) outline.col(static_cast<Eigen::Index>(k)) = corners[k];
  return outline;
}

Mat2 rotation(double angle) {
  Mat2 turn;
  turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return turn;
}

/// A block on fixed ones that together are a plane, gravity turned instead of it; cut where `joints` are.
Scene block_on_plane(double angle, double width, double height, const std::vector<double>& joints = {}) {
  Scene scene = rigid_rock();
  double from = -10;
  for (const double to : joints) {
    scene.blocks.push_back(rock_block(rectangle(from, -1, to - from, 1), true));
    from = to;
  }
  scene.blocks.push_back(rock_block(rectangle(from, -1, 10 - from, 1), true));
  scene.blocks.push_back(rock_block(rectangle(0, 0, width, height)));
  scene.analysis.gravity = rotation(angle) * scene.analysis.gravity;
  return scene;
}

void push_sideways(Scene& scene) {
  for (std::size_t b = 0; b < scene.blocks.size(); ++b) {
    if (scene.blocks[b].fixed) continue;
    Load load;
    load.kind = Load::Kind::body;
    load.block = static_cast<int>(b);
    load.force.value = Vec2(scene.materials[0].density * scene.analysis.gravity.norm(), 0);
    scene.loads.push_back(load);
  }
}

}  // namespace

TEST(LimitAnalysis, BlockOnAPlaneSlidesAtItsAngle) {
  for (const double angle : {5., 30., 60., 80.})
    EXPECT_NEAR(*least_friction(rigid_blocks(block_on_plane(angle * degree, 8, 1))), std::tan(angle * degree),
                2e-6)
        << angle;
}

TEST(LimitAnalysis, JointsInThePlaneDoNotHoldTheBlock) {
  for (const std::vector<double>& joints : {std::vector{0.}, {0., 2.}, {1e-3, 1., 2.}})
    EXPECT_NEAR(*least_friction(rigid_blocks(block_on_plane(0.5, 2, 1, joints))), std::tan(0.5), 2e-6);
}

TEST(LimitAnalysis, NoFrictionKeepsASlenderBlockFromToppling) {
  EXPECT_TRUE(least_friction(rigid_blocks(block_on_plane(0.499 * degree, 1, 100))));
  EXPECT_FALSE(least_friction(rigid_blocks(block_on_plane(0.6 * degree, 1, 100))));
}

TEST(LimitAnalysis, HousnersBlockRocksAtWidthOverHeightAndSlidesAtMu) {
  Scene scene = block_on_plane(0, 1, 4);
  push_sideways(scene);
  const RigidBlocks blocks = rigid_blocks(scene);
  EXPECT_NEAR(*largest_factor(blocks, 1), 0.25, 1e-9);
  EXPECT_NEAR(*largest_factor(blocks, 0.1), 0.1, 1e-9);
}

TEST(LimitAnalysis, LoadsThatPressCanGrowForEver) {
  Scene scene = block_on_plane(0, 1, 1);
  Load load;
  load.kind = Load::Kind::point;
  load.block = 1;
  load.at = Vec2(0.5, 1);
  load.force.value = Vec2(0, -1);
  scene.loads = {load};
  EXPECT_TRUE(std::isinf(*largest_factor(rigid_blocks(scene), 0.5)));
  scene.analysis.gravity = Vec2(1, 0);
  EXPECT_FALSE(largest_factor(rigid_blocks(scene), 0)) << "the weight alone moves it";
}

TEST(LimitAnalysis, PointLoadsActWhereTheyAre) {
  // Pulled up at a corner: it turns about the other when the pull is half the weight.
  Scene scene = block_on_plane(0, 2, 1);
  Load load;
  load.kind = Load::Kind::point;
  load.block = 1;
  load.at = Vec2(2, 1);
  load.force.value = Vec2(0, scene.materials[0].density * 2 * scene.analysis.gravity.norm());
  scene.loads = {load};
  EXPECT_NEAR(*largest_factor(rigid_blocks(scene), 0.5), 0.5, 1e-9);
}

TEST(LimitAnalysis, StackStandsWhileEveryPartIsOverWhatBearsIt) {
  // Shifted by 1/2, 1/4, 1/6, ... from the top; a little more, and it falls.
  for (const double part : {0.999, 1.001}) {
    Scene scene = rigid_rock();
    double x = 0;
    for (int below_top = 0; below_top < 6; ++below_top) {
      scene.blocks.push_back(rock_block(rectangle(x, -0.2 * below_top, 1, 0.2), below_top == 5));
      x -= part * 0.5 / (below_top + 1);
    }
    EXPECT_EQ(can_be_held(rigid_blocks(scene), 0.5), part < 1);
    EXPECT_EQ(least_friction(rigid_blocks(scene)).has_value(), part < 1);
  }
}

TEST(LimitAnalysis, WedgePushesTwoBlocksApart) {
  // 2 N (sin a + mu cos a) = w of the wedge, N (cos a - mu sin a) = mu (W + w/2) of a block.
  for (const double angle : {10., 20., 35.}) {
    const double a = angle * degree;
    const auto face = [&](double y) { return 0.5 + (y - 1) * std::tan(a); };
    const Points right = polygon({{face(0.4), 0}, {12, 0}, {12, 2}, {face(2), 2}, {face(0.4), 0.4}});
    Scene scene = rigid_rock();
    scene.blocks = {rock_block(rectangle(-20, -1, 40, 1), true), rock_block(right),
                    rock_block((Mat2() << -1, 0, 0, 1).finished() * right),
                    rock_block(polygon({{-face(1), 1}, {face(1), 1}, {face(2.5), 2.5}, {-face(2.5), 2.5}}))};
    const RigidBlocks blocks = rigid_blocks(scene);
    const double wedge = -blocks.dead(1, 3), block = -blocks.dead(1, 1), mu = *least_friction(blocks);
    const double normal = wedge / 2 / (std::sin(a) + mu * std::cos(a));
    EXPECT_NEAR(normal * (std::cos(a) - mu * std::sin(a)), mu * (block + wedge / 2), 1e-5 * block) << angle;
  }
}

namespace {

/// A semicircular arch of mean radius 1 on the ground; edges along it in `parts` chords.
Scene arch(int n_voussoirs, double thickness, int parts) {
  Scene scene = rigid_rock();
  scene.blocks.push_back(rock_block(rectangle(-3, -1, 6, 1), true));
  const auto at = [&](double radius, double joint) {
    const double angle = std::numbers::pi * joint / n_voussoirs;
    return Vec2(radius * std::cos(angle), radius * std::sin(angle));
  };
  for (int k = 0; k < n_voussoirs; ++k) {
    std::vector<Vec2> corners;
    for (int part = 0; part <= parts; ++part) corners.push_back(at(1 + thickness / 2, k + 1. * part / parts));
    for (int part = parts; part >= 0; --part) corners.push_back(at(1 - thickness / 2, k + 1. * part / parts));
    scene.blocks.push_back(rock_block(polygon(corners)));
  }
  return scene;
}

double least_thickness(int n_voussoirs, double friction, int parts = 1) {
  double falls = 0.05, stands = 0.3;
  while (stands - falls > 1e-5) {
    const double tried = (falls + stands) / 2;
    (can_be_held(rigid_blocks(arch(n_voussoirs, tried, parts)), friction) ? stands : falls) = tried;
  }
  return stands;
}

}  // namespace

TEST(LimitAnalysis, LeastThicknessOfSemicircularArches) {
  EXPECT_NEAR(least_thickness(7, 0.7, 40), 0.0963, 1e-4);
  EXPECT_NEAR(least_thickness(101, 0.7), 0.1075, 2e-4);
}

TEST(LimitAnalysis, ArchesOnLittleFrictionHaveToBeThicker) {
  struct Known {
    double friction, thickness;
  };
  for (const Known& known : {Known{0.38, 0.1217}, {0.36, 0.1416}, {0.34, 0.1628}})
    EXPECT_NEAR(least_thickness(101, known.friction), known.thickness, 0.01 * known.thickness)
        << known.friction;
}

TEST(LimitAnalysis, BlockOverAShaftOfItsWidthFalls) {
  Scene scene = rigid_rock();
  scene.blocks = {rock_block(rectangle(0, 0, 1, 1)), rock_block(rectangle(-1, -1, 1, 1), true),
                  rock_block(rectangle(1, -1, 1, 1), true)};
  EXPECT_FALSE(least_friction(rigid_blocks(scene)));
}

TEST(LimitAnalysis, CornerHoldsWhatCannotPassIt) {
  // Between two walls, its lower corner on an upward one; or on nothing.
  Scene scene = rigid_rock();
  scene.blocks = {rock_block(polygon({{0, 0}, {1, 1}, {1, 3}, {-1, 3}, {-1, 1}})),
                  rock_block(rectangle(1, 1, 1, 2), true), rock_block(rectangle(-2, 1, 1, 2), true)};
  EXPECT_FALSE(can_be_held(rigid_blocks(scene), 0));
  scene.blocks.push_back(rock_block(polygon({{0, 0}, {-1, -1}, {1, -1}}), true));
  EXPECT_TRUE(can_be_held(rigid_blocks(scene), 0));
}

TEST(LimitAnalysis, FactorsDoNotDependOnHowTheSceneIsStated) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const LoadedMasonry masonry = random_masonry(seed);
    const Scene& scene = masonry.scene;
    EXPECT_NEAR(*largest_factor(rigid_blocks(scene), masonry.friction), 1, 1e-7) << seed;
    for (const Scene& other :
         {turned(scene, rotation(1)), turned(scene, (Mat2() << -1, 0, 0, 1).finished()),
          renumbered(scene, 1, true), scaled(scene, {1e-2, 1e4, 10}), moved(scene, {1e3, 2e3})})
      EXPECT_NEAR(*largest_factor(rigid_blocks(other), masonry.friction), 1, 1e-6) << seed;
  }
}

TEST(LimitAnalysis, SlabsSlideAtTheirDip) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Slab slab = random_slab(seed);
    EXPECT_NEAR(*least_friction(rigid_blocks(slab.scene)), std::tan(slab.dip), 3e-6) << seed;
  }
}

TEST(LimitAnalysis, RefusesWhatItDoesNotKnow) {
  Scene scene = block_on_plane(0, 1, 1);
  scene.loads.resize(1);
  scene.loads[0].kind = Load::Kind::pressure;
  EXPECT_THROW(rigid_blocks(scene), ddacontact::Error);
  scene.loads.clear();
  scene.blocks[0].fixed = false;
  scene.blocks[0].fixed_vertices = {0};
  EXPECT_THROW(rigid_blocks(scene), ddacontact::Error);
}
