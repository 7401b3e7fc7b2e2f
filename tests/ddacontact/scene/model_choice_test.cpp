#include <ddacontact/output/cell_view.hpp>
#include <ddacontact/scene/builder.hpp>
#include <ddacontact/scene/model_choice.hpp>
#include <ddacontact/scene/reader.hpp>
#include <polyfem/geometry/area_moments.hpp>

#include <gtest/gtest.h>

#include <set>

using namespace ddacontact;

namespace {

Points outline(std::initializer_list<Vec2> vertices) {
  Points polygon(2, static_cast<Index>(vertices.size()));
  Index k = 0;
  for (const Vec2& v : vertices) polygon.col(k++) = v;
  return polygon;
}
Points box(double x, double y, double width, double height) {
  return outline({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}});
}

/// Blocks of the model "auto" on a held floor, y = 0.
Scene scene_of_outlines(std::initializer_list<Points> outlines) {
  Scene scene;
  scene.analysis.steps = 1;
  scene.analysis.time_step = 1e-3;
  scene.materials = {{"rock", 2500, 1e9, 0.3}};
  scene.joints = {{"joint", 30, 0, 0, std::nullopt, 0, 0}};
  scene.contact.normal_stiffness = 4e10;
  scene.contact.tangential_stiffness = 1.6e10;
  for (const Points& of : outlines) {
    BlockDescription& block = scene.blocks.emplace_back();
    block.vertices = of;
    block.model = BlockModel::automatic;
  }
  BlockDescription& floor = scene.blocks.emplace_back();
  floor.vertices = box(-50, -1, 100, 1);
  floor.fixed = true;
  floor.model = BlockModel::automatic;
  return scene;
}

struct Chosen {
  std::string model, reason;
};
Chosen first(const Scene& scene, std::size_t block = 0) {
  const BuiltScene built = build(scene);
  return {built.labels.block_models[block], built.labels.block_reasons[block]};
}

TEST(ModelChoice, GoesByShapeWhereNothingBends) {
  EXPECT_EQ(first(scene_of_outlines({box(0, 0, 1, 1)})).model, "wachspress");
  const Chosen L = first(scene_of_outlines({outline({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}})}));
  EXPECT_EQ(L.model, "mean_value");
  EXPECT_EQ(L.reason, "concave");
  const Chosen middle = first(scene_of_outlines({outline({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}})}));
  EXPECT_EQ(middle.model, "mean_value");
  EXPECT_EQ(middle.reason, "a corner is next to straight");
  const Points clockwise = box(0, 0, 1, 1).rowwise().reverse();
  EXPECT_EQ(first(scene_of_outlines({clockwise})).model, "wachspress");
}

/// A block on a slope, with sides that touch to the last digit, a little less or a little more.
TEST(ModelChoice, DoesNotHangOnTheLastDigitOfAGap) {
  const double half = std::sqrt(0.5);
  Mat2 R;
  R << half, half, -half, half;
  std::set<std::string> reasons;
  for (const double gap : {0., 1e-15, -1e-15, 1e-9, -1e-9}) {
    Scene scene = scene_of_outlines({R * box(0, gap, 4, 2)});
    scene.analysis.mode = Mode::statics;
    scene.blocks[1].vertices = R * scene.blocks[1].vertices;
    const Chosen chosen = first(scene);
    EXPECT_EQ(chosen.model, "mesh") << gap;
    reasons.insert(chosen.reason);
  }
  EXPECT_EQ(reasons.size(), 1);
}

TEST(ModelChoice, ABeamIsDividedAndAColumnIsNot) {
  const Scene portal = scene_of_outlines({box(0, 2, 6, 0.5), box(0, 0, 1, 2), box(5, 0, 1, 2)});
  const Chosen beam = first(portal);
  EXPECT_EQ(beam.model, "mesh");
  EXPECT_NE(beam.reason.find("bent ("), std::string::npos) << beam.reason;
  const Chosen column = first(scene_of_outlines({box(0, 0, 1, 6)}));
  EXPECT_EQ(column.model, "wachspress");
  EXPECT_EQ(column.reason, "convex");
}

/// Many blocks that are not slender stay single; few are divided in two across.
TEST(ModelChoice, FewSquatBlocksAreDividedWhereTheyBend) {
  const auto leaning = [](int n) {
    Scene scene = scene_of_outlines({});
    scene.analysis.mode = Mode::statics;
    scene.blocks.clear();
    for (int k = 0; k < n; ++k) {
      BlockDescription& block = scene.blocks.emplace_back();
      block.vertices = box(3 * k, 0, 1, 1);
      block.model = BlockModel::automatic;
      block.fixed_vertices = {0, 1};
      Load push;
      push.kind = Load::Kind::point;
      push.block = k;
      push.at = {3. * k, 1};
      push.force = {TimeFunction::Kind::constant, {1e6, 0}, {}};
      scene.loads.push_back(push);
    }
    return scene;
  };
  EXPECT_EQ(first(leaning(3)).model, "mesh");
  const Chosen of_many = first(leaning(300));
  EXPECT_EQ(of_many.model, "wachspress");
  EXPECT_NE(of_many.reason.find("too many"), std::string::npos) << of_many.reason;
}

TEST(ModelChoice, SquatBlocksAreDividedOnlyWhereNothingMoves) {
  Scene scene = scene_of_outlines({box(0, 0, 4, 2)});
  EXPECT_EQ(first(scene).model, "wachspress");
  scene.analysis.mode = Mode::statics;
  EXPECT_EQ(first(scene).model, "mesh");
  scene.stages = {scene.stage("settle"), scene.stage("load")};
  EXPECT_EQ(first(scene).model, "mesh");
  scene.stages[1].analysis.mode = Mode::dynamic;
  EXPECT_EQ(first(scene).model, "wachspress");
}

TEST(ModelChoice, AColumnPushedAsideBends) {
  Scene scene = scene_of_outlines({box(0, 0, 1, 6)});
  Load push;
  push.kind = Load::Kind::point;
  push.at = {0, 5};
  push.force = {TimeFunction::Kind::constant, {5e3, 0}, {}};
  scene.loads = {push};
  EXPECT_EQ(first(scene).model, "mesh");
}

/// A wall of 12 x 2 m, whose weight alone does not bend it.
TEST(ModelChoice, CountsWhatActsInAnyStage) {
  Scene scene = scene_of_outlines({box(0, 0, 2, 12)});
  scene.blocks[0].fixed_vertices = {0, 1};
  scene.analysis.mode = Mode::statics;
  EXPECT_EQ(first(scene).model, "wachspress");
  Water water;
  water.density = 1000;
  water.table = outline({{-9, 12}, {0.8, 12}, {1.2, -5}, {9, -5}});
  Scene wet = scene;
  wet.water = water;
  EXPECT_EQ(first(wet).model, "mesh");
  scene.stages = {scene.stage("weight"), scene.stage("more")};
  EXPECT_EQ(first(scene).model, "wachspress");
  Scene later = scene;
  later.stages[1].water = water;
  EXPECT_EQ(first(later).model, "mesh");
  later = scene;
  later.stages[1].analysis.gravity = {1, -9.8};
  EXPECT_EQ(first(later).model, "mesh");
  later = scene;
  Load wind;
  wind.kind = Load::Kind::pressure;
  wind.edge = 3;
  wind.force = {TimeFunction::Kind::constant, {1e4, 0}, {}};
  later.loads = {wind};
  later.stages[1].loads = {0};
  EXPECT_EQ(first(later).model, "mesh");
}

/// A grouted bolt goes on without the block that its first nodes were in.
TEST(ModelChoice, CountsABoltThatHasLostABlock) {
  Scene scene = scene_of_outlines({box(0, 0, 2, 1), box(0, 1, 2, 1)});
  scene.analysis.mode = Mode::statics;
  RockBolt bolt;
  bolt.kind = RockBolt::Kind::grouted;
  bolt.from = {1, -0.5};
  bolt.to = {1, 1.5};
  bolt.area = 5e-4;
  bolt.young = 2e11;
  bolt.bond_stiffness = 1e9;
  scene.bolts = {bolt};
  scene.stages = {scene.stage("all"), scene.stage("without")};
  scene.stages[1].removed = {1};
  EXPECT_FALSE(first(scene).model.empty());
}

TEST(ModelChoice, AColumnWhoseHeadASupportMovesBends) {
  Scene scene = scene_of_outlines({box(0, 0, 1, 10)});
  scene.analysis.mode = Mode::statics;
  const TimeFunction aside{TimeFunction::Kind::ramp, {0.01, 0}, {}};
  scene.supports = {{0, {0, 1}, true, true, {}}, {0, {2, 3}, true, false, aside}};
  EXPECT_EQ(first(scene).reason, "supports deform it");
  scene.supports[0] = {0, {0, 1}, true, true, aside};
  EXPECT_EQ(first(scene).model, "wachspress");
  Scene squat = scene_of_outlines({box(0, 0, 1, 1)});
  squat.analysis.mode = Mode::statics;
  squat.supports = {{0, {0, 1}, true, true, {}}, {0, {2, 3}, true, true, aside}};
  EXPECT_EQ(first(squat).model, "mesh");
}

TEST(ModelChoice, WhatIsNotLoadedYetGoesByItsSlenderness) {
  const Chosen falling = first(scene_of_outlines({box(0, 5, 6, 1)}));
  EXPECT_EQ(falling.model, "mesh");
  EXPECT_NE(falling.reason.find("not known"), std::string::npos) << falling.reason;
}

TEST(ModelChoice, LeavesWhatIsStatedAndWhatIsHeld) {
  Scene scene = scene_of_outlines({box(0, 5, 6, 1)});
  EXPECT_EQ(first(scene, 1).reason, "held, convex");
  scene.blocks[0].model = BlockModel::affine;
  EXPECT_EQ(first(scene).model, "affine");
  EXPECT_EQ(first(scene).reason, "");
  scene.blocks[0].model = BlockModel::automatic;
  scene.analysis.kinematics = Kinematics::incremental;
  scene.analysis.scheme = Scheme::dda;
  EXPECT_EQ(first(scene).model, "wachspress") << "meshes need corotational kinematics";
}

TEST(ModelChoice, SlendernessIsTheRatioOfTheSidesOfARectangle) {
  EXPECT_NEAR(slenderness(box(3, 4, 8, 2)), 4, 1e-12);
  EXPECT_NEAR(slenderness(box(3, 4, 2, 8)), 4, 1e-12);
  EXPECT_NEAR(slenderness(box(3, 4, 2, 8).rowwise().reverse()), 4, 1e-12);
}

/// A stress of 10 MPa that a block is relieved of leaves that of its weight, some 10 kPa: what a frame shows
/// in its cells is their mean.
TEST(MeshedBlocks, FramesShowTheStressThatIsLeftOfARelievedOne) {
  const Scene scene = *read_scene_text(R"(format = 1
[analysis]
mode = "static"
steps = 20
time_step = 0.1
[[material]]
name = "rock"
density = 2500.0
young = "20 GPa"
poisson = 0.2
[[joint]]
friction_angle = 0.0
[[block]]
name = "floor"
material = "rock"
vertices = [[-1, -1], [2, -1], [2, 0], [-1, 0]]
fixed = true
[[block]]
name = "block"
material = "rock"
model = "mesh"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
stress = ["-10 MPa", "-10 MPa", 0]
)",
                                       "block.toml")
                           .scene;
  const BuiltScene built = build(scene);
  for (int k = 0; k < 20; ++k) ASSERT_TRUE(built.stepper->step());
  const Frame frame = capture_frame(*built.stepper, built.labels, {});
  Vec3 sum = Vec3::Zero();
  for (int c = 0; c < frame.n_cells(); ++c) {
    const CellView view(frame, c);
    if (view.cell().block == 1) sum += polyfem::signed_area(view.local_corners()) * view.mean_stress();
  }
  EXPECT_NEAR(frame.mean_stress(1, 1), -12250, 200);
  EXPECT_LT((sum - frame.mean_stress.col(1)).norm(), 0.02 * frame.mean_stress.col(1).norm());
}

/// Of a wall of a thousand bricks the forces are known, too: those of a beam that lies on its two ends. With
/// friction from the start they are not found.
TEST(ModelChoice, KnowsTheForcesInALargeWall) {
  Scene scene = scene_of_outlines({box(-10.25, 10, 20.75, 0.5)});
  for (int row = 0; row < 20; ++row)
    for (int column = 0; column < 50; ++column) {
      const double x = -12.5 + 0.5 * column + (row % 2 == 0 ? 0 : 0.25), y = 0.5 * row;
      if (row == 19 && x > -10 && x < 10) continue;  // the beam spans what is left out
      scene.blocks.push_back(scene.blocks.front());
      scene.blocks.back().vertices = box(x, y, 0.5, 0.5);
    }
  const Chosen beam = first(scene);
  EXPECT_EQ(beam.model, "mesh");
  EXPECT_EQ(beam.reason.substr(0, 4), "bent") << beam.reason;
}

}  // namespace
