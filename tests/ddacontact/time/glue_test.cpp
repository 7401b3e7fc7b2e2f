/// \file Joints that are glued while a stage lasts.
#include "../simple_scenes.hpp"

#include <algorithm>
#include <string>

using namespace support;

namespace {

constexpr double dt = 0.01, young = 10e9, weight = 2500 * 9.8;  // of a block of 1 m2
/// How far what its sudden weight or a fall of 2 mm makes a block vibrate may carry it, m: g / w t, v / w.
constexpr double vibration = 1e-3;

/// Default mechanics of stiff rock whose joint has neither friction nor strength.
Scene rock(std::vector<BlockDescription> blocks) {
  Scene scene;
  scene.analysis.time_step = dt;
  scene.analysis.max_displacement_ratio = 1;
  scene.materials = {{"rock", 2500, young, 0.2}};
  scene.joints = {{"joint", 0, 0, 0, std::nullopt}};
  scene.contact.normal_stiffness = 40 * young;
  scene.contact.tangential_stiffness = 16 * young;
  scene.blocks = std::move(blocks);
  return scene;
}

StageDescription stage_of(const Scene& scene, bool glued, Mode mode, int steps) {
  StageDescription stage = scene.stage("");
  stage.analysis.mode = mode;
  stage.analysis.steps = steps;
  for (Joint& joint : stage.joints) joint.glued = glued;
  return stage;
}

/// Glued, then not.
Scene glued_first(Scene scene, Mode mode, int glued_steps, int steps) {
  scene.stages = {stage_of(scene, true, mode, glued_steps), stage_of(scene, false, Mode::dynamic, steps)};
  return scene;
}

/// A block of 1 m x 1 m on a slope of 40 degrees.
Scene slope() {
  const double angle = -radians(40);
  return rock(
      {block(turned(rectangle(-2, -1, 20, 1), angle), true), block(turned(rectangle(0, 0, 1, 1), angle))});
}

/// One that hangs below a ceiling.
Scene ceiling() {
  return rock({block(rectangle(-1, 1, 3, 1), true), block(rectangle(0, 0, 1, 1))});
}

double furthest(const Stepper& stepper, int b) {
  const Range& v = stepper.blocks().block(b).vertices();
  return stepper.blocks()
      .displacements(stepper.state())
      .middleCols(v.first, v.count)
      .colwise()
      .norm()
      .maxCoeff();
}

Vec2 contact_forces(const Stepper& stepper) {
  Vec2 sum = Vec2::Zero();
  for (const ContactRecord& contact : stepper.contacts()) sum += Vec2(contact.normal, contact.shear);
  return sum;
}

int n_bonded(const Stepper& stepper) {
  return static_cast<int>(std::ranges::count_if(
      stepper.contacts(), [](const ContactRecord& contact) { return contact.history.bonded; }));
}

/// How a scene is computed.
struct Mechanics {
  std::string name;
  Mode mode;
  BlockModel model = BlockModel::wachspress;
  void (*change)(Scene&) = [](Scene&) {};
};

class Glue : public testing::TestWithParam<Mechanics> {
 protected:
  static Scene of(Scene scene) {
    for (BlockDescription& b : scene.blocks) b.model = GetParam().model;
    GetParam().change(scene);
    return scene;
  }
};

INSTANTIATE_TEST_SUITE_P(
    All, Glue,
    testing::Values(Mechanics{"Dynamic", Mode::dynamic}, Mechanics{"Static", Mode::statics},
                    Mechanics{"Affine", Mode::dynamic, BlockModel::affine},
                    Mechanics{"AffineStatic", Mode::statics, BlockModel::affine},
                    Mechanics{"MeanValue", Mode::dynamic, BlockModel::mean_value},
                    Mechanics{"Mesh", Mode::dynamic, BlockModel::mesh},
                    Mechanics{"Midpoint", Mode::dynamic, BlockModel::wachspress,
                              [](Scene& scene) { scene.analysis.scheme = Scheme::midpoint; }},
                    Mechanics{"Classic", Mode::dynamic, BlockModel::wachspress,
                              [](Scene& scene) {
                                scene.contact.method = ContactMethod::classic;
                                scene.contact.penetration_tolerance = 0;
                              }},
                    Mechanics{"Springs", Mode::dynamic, BlockModel::wachspress,
                              [](Scene& scene) { scene.contact.penetration_tolerance = 0; }},
                    Mechanics{"Paper", Mode::dynamic, BlockModel::wachspress,
                              [](Scene& scene) {
                                scene = paper_mechanics(scene);
                                scene.analysis.preset = Preset::paper;
                              }},
                    Mechanics{"PaperStatic", Mode::statics, BlockModel::affine,
                              [](Scene& scene) {
                                scene = paper_mechanics(scene);
                                scene.analysis.preset = Preset::paper;
                              }}),
    [](const auto& test) { return test.param.name; });

}  // namespace

TEST_P(Glue, HoldsABlockOnASlopeWithoutFrictionAndLetsItSlideThen) {
  const Scene scene = glued_first(of(slope()), GetParam().mode, 20, 20);
  BuiltScene built = build(scene);
  Stepper& stepper = *built.stepper;
  run(stepper, 20);
  EXPECT_LE(furthest(stepper, 1), 1e-5) << "what its weight strains it by, and springs";
  for (const ContactRecord& contact : stepper.contacts()) {
    EXPECT_EQ(contact.history.state, ContactState::stick);
    EXPECT_LE(std::abs(contact.end_slip), 1e-6);
  }
  const Vec2 held = centre(stepper, 1);
  run(stepper, 20);
  const double t = 20 * dt, s = 9.8 * std::sin(radians(40)) * t * t / 2;
  EXPECT_NEAR((centre(stepper, 1) - held).norm(), s, vibration);
  EXPECT_LE(std::abs(stepper.energy().balance_error()), 1e-6);
}

TEST_P(Glue, BearsTensionAndLetsGoThen) {
  const Scene scene = glued_first(of(ceiling()), GetParam().mode, 40, 20);
  BuiltScene built = build(scene);
  Stepper& stepper = *built.stepper;
  run(stepper, 39);
  EXPECT_NEAR(contact_forces(stepper)[0], -weight, GetParam().mode == Mode::statics ? 1e-6 * weight : weight);
  run(stepper, 1);
  EXPECT_LE(furthest(stepper, 1), 1e-5);
  const Vec2 held = centre(stepper, 1);
  run(stepper, 20);
  EXPECT_EQ(contact_forces(stepper), Vec2(0, 0));
  const double t = 20 * dt, s = 9.8 * t * t / 2;
  EXPECT_NEAR((centre(stepper, 1) - held).norm(), s, vibration);
  EXPECT_LE(std::abs(stepper.energy().balance_error()), 1e-6);
}

TEST_P(Glue, HoldsWhatClosesWhileItLasts) {
  Scene scene = of(slope());
  const double angle = -radians(40);
  scene.blocks[1].vertices = turned(rectangle(0, 0.002, 1, 1), angle);
  scene.stages = {stage_of(scene, true, Mode::dynamic, 100)};
  BuiltScene built = build(scene);
  Stepper& stepper = *built.stepper;
  const auto is_closed = [](const ContactRecord& contact) { return contact.closed(); };
  run(stepper, 5);
  EXPECT_GT(centre(stepper, 1).y(), 0) << "it falls";
  run(stepper, 85);
  ASSERT_GE(std::ranges::count_if(stepper.contacts(), is_closed), 2);
  const Vec2 held = centre(stepper, 1);
  run(stepper, 10);
  EXPECT_LE((centre(stepper, 1) - held).norm(), vibration) << "what it came with is elastic";
}

TEST(Glue, AddsNoForce) {
  // Gaps and overlaps below the coincidence tolerance, of a block between two walls.
  for (const double gap : {0., 9e-7, 3e-7, -9e-7}) {
    Scene scene = rock({block(rectangle(-1, 0, 1, 1), true), block(rectangle(gap, 0, 1, 1)),
                        block(rectangle(1 + 2 * gap, 0, 1, 1), true)});
    scene.analysis.gravity = Vec2(0, 0);
    scene.stages = {stage_of(scene, true, Mode::dynamic, 3)};
    BuiltScene built = build(scene);
    run(*built.stepper, 3);
    EXPECT_EQ(std::ranges::count_if(built.stepper->contacts(), &ContactRecord::closed), 4) << gap;
    EXPECT_LE(built.stepper->reactions().cwiseAbs().maxCoeff(), 1e-9 * young) << gap;
    EXPECT_LE(furthest(*built.stepper, 1), 1e-15) << gap;
  }
}

TEST(Glue, DoesNotReachAcrossGaps) {
  Scene scene = ceiling();
  scene.blocks[1].vertices.row(1).array() -= 2e-6;
  scene.stages = {stage_of(scene, true, Mode::dynamic, 20)};
  BuiltScene built = build(scene);
  run(*built.stepper, 20);
  EXPECT_NEAR(travel(*built.stepper, 1).y(), -9.8 * 0.2 * 0.2 / 2, 1e-5);
}

TEST(Glue, TakesHoldOfWhatTouchesWhenItsStageBegins) {
  // It slides without friction; then gravity turns round.
  for (const Mode mode : {Mode::dynamic, Mode::statics}) {
    Scene scene = rock({block(rectangle(-1, -1, 9, 1), true), block(rectangle(0, 0, 1, 1))});
    scene.blocks[1].velocity = Vec2(0.1, 0);
    scene.stages = {stage_of(scene, false, Mode::dynamic, 20), stage_of(scene, true, mode, 20),
                    stage_of(scene, false, Mode::dynamic, 20)};
    scene.stages[1].analysis.gravity = Vec2(3, 9.8);
    BuiltScene built = build(scene);
    Stepper& stepper = *built.stepper;
    run(stepper, 21);
    const Vec2 held = centre(stepper, 1);
    EXPECT_GT(held.x(), 0.515);
    run(stepper, 19);
    EXPECT_LE((centre(stepper, 1) - held).norm(), 1e-5);
    run(stepper, 20);
    EXPECT_LE(std::abs(centre(stepper, 1).y() - held.y()), 1e-5) << "gravity presses it down again";
    EXPECT_LE(std::abs(stepper.energy().balance_error()), 1e-7);
  }
}

TEST(Glue, BreaksNoBondAndMakesNone) {
  for (const double strength : {0., 2 * weight, 0.2 * weight}) {
    Scene scene = rock({block(rectangle(-1, 1, 3, 1), true), block(rectangle(0, 0, 1, 1))});
    scene.joints[0].tensile_strength = scene.joints[0].cohesion = strength;
    scene = glued_first(scene, Mode::statics, 10, 20);
    scene.stages[0].analysis.gravity = Vec2(30, -98);
    BuiltScene built = build(scene);
    Stepper& stepper = *built.stepper;
    run(stepper, 10);
    EXPECT_NEAR(contact_forces(stepper)[0], -10 * weight, 1e-6 * weight);
    EXPECT_EQ(n_bonded(stepper), 2);
    run(stepper, 20);
    const bool holds = strength > weight;
    EXPECT_EQ(n_bonded(stepper), holds ? 2 : 0) << strength;
    if (holds)
      EXPECT_LE(furthest(stepper, 1), 1e-4);
    else  // a bond bears its strength to the end of the step in which it breaks, half a step after the glue
      EXPECT_NEAR(travel(stepper, 1).y(), -9.8 * 0.2 * (0.1 - strength / weight * 0.005), 2e-4);
  }
  // One that broke before stays broken after.
  Scene scene = rock({block(rectangle(-1, -1, 9, 1), true), block(rectangle(0, 0, 1, 1))});
  scene.joints[0].cohesion = 10;
  scene.blocks[1].velocity = Vec2(1, 0);
  scene.stages = {stage_of(scene, false, Mode::dynamic, 10), stage_of(scene, true, Mode::dynamic, 10),
                  stage_of(scene, false, Mode::dynamic, 10)};
  scene.stages[2].joints[0].cohesion = 1e6;
  scene.stages[2].analysis.gravity = Vec2(5, -9.8);
  BuiltScene built = build(scene);
  run(*built.stepper, 10);
  EXPECT_EQ(n_bonded(*built.stepper), 0);
  run(*built.stepper, 10);
  EXPECT_EQ(n_bonded(*built.stepper), 0);
  const double before = travel(*built.stepper, 1).x();
  run(*built.stepper, 10);
  EXPECT_NEAR(travel(*built.stepper, 1).x() - before, 5 * 0.1 * 0.1 / 2, 1e-4);
}

TEST(Glue, OfOneJointLeavesOthers) {
  // Two blocks on a slope without friction: the glued one stays.
  Scene scene = slope();
  const double angle = -radians(40);
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1].name = "ice";
  scene.blocks.push_back(block(turned(rectangle(4, 0, 1, 1), angle)));
  scene.blocks[2].material = 1;
  scene.joints.push_back({"glue", 0, 0, 0, std::array<int, 2>{0, 1}});
  scene.stages = {scene.stage("")};
  scene.stages[0].analysis.steps = 20;
  scene.stages[0].joints[1].glued = true;
  const BuiltScene built = run(scene);
  const double s = 9.8 * std::sin(radians(40)) * 0.2 * 0.2 / 2;
  EXPECT_NEAR(travel(*built.stepper, 1).norm(), s, 1e-3 * s);
  EXPECT_LE(furthest(*built.stepper, 2), 1e-5);
}

/// A region cut by three slanting joints into blocks some of whose held corners touch each other: these
/// bear nothing that could be found, and whatever is wrong about them in the last digit must not grow.
TEST(Glue, BlocksWhoseHeldCornersTouchStandAsOne) {
  const auto polygon = [](std::initializer_list<Vec2> corners) {
    Points p(2, static_cast<Index>(corners.size()));
    Index k = 0;
    for (const Vec2& corner : corners) p.col(k++) = corner;
    return p;
  };
  Scene scene =
      rock({block(polygon({{0, 0}, {5.230340386863304, 0}, {8, 1.9393365393933664}, {8, 5.601660305677683}})),
            block(polygon({{5.230340386863304, 0}, {8, 0}, {8, 1.9393365393933664}})),
            block(polygon({{0, 3.6623237662843167}, {3.338547653589444, 6}, {0, 6}})),
            block(polygon(
                {{0, 0}, {8, 5.601660305677683}, {8, 6}, {3.338547653589444, 6}, {0, 3.6623237662843167}}))});
  scene.supports = {{0, {0, 1}, true, true, {}}, {1, {0, 1}, true, true, {}}, {3, {0}, true, true, {}}};
  for (const BlockModel model : {BlockModel::affine, BlockModel::mesh}) {
    scene.analysis.block_model = model;
    for (BlockDescription& one : scene.blocks) one.model = model;
    scene.stages = {stage_of(scene, true, Mode::statics, 40)};
    const BuiltScene built = run(scene);
    Vec2 reactions = Vec2::Zero();
    for (const Vec2& reaction : built.stepper->reactions().colwise()) reactions += reaction;
    EXPECT_NEAR(reactions.y(), 48 * weight, 2e-5 * 48 * weight);
    EXPECT_NEAR(reactions.x(), 0, 2e-5 * 48 * weight);
    for (int b = 0; b < 4; ++b) EXPECT_LT(furthest(*built.stepper, b), 1e-4);
  }
}

/// A square on a slope presses on its upper corner so little that glue bears five times that along it.
/// Contacts whose glue, let go at once, is more than their joint bears are told; those let go statically are
/// not.
TEST(GlueLetGo, ByDynamicStepsIsToldWhereJointsCannotBearIt) {
  const auto notes_of = [](double friction_angle, std::vector<Mode> without_glue) {
    Scene scene = slope();
    scene.joints[0].friction_angle = friction_angle;
    scene.stages = {stage_of(scene, true, Mode::statics, 10)};
    for (const Mode mode : without_glue) scene.stages.push_back(stage_of(scene, false, mode, 1));
    return run(scene).stepper->notes();
  };
  const std::vector<std::string> told = notes_of(20, {Mode::dynamic});
  ASSERT_EQ(told.size(), 1u);
  EXPECT_NE(told[0].find("(contacts: 2)"), std::string::npos) << told[0];
  EXPECT_TRUE(notes_of(85, {Mode::dynamic}).empty());
  EXPECT_TRUE(notes_of(20, {Mode::statics}).empty());
  EXPECT_TRUE(notes_of(20, {Mode::statics, Mode::dynamic}).empty());
}
