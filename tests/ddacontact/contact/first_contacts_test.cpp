// How contacts begin: joints with a stiffness under the stress of their blocks, and what blocks bring that
// come in.
#include <tests/ddacontact/simple_scenes.hpp>
#include <tests/ddacontact/time/staged_scenes.hpp>

#include <cmath>

using namespace support;

namespace {

constexpr double joint_stiffness = 1e10;  // Pa/m

/// Blocks in joints of that stiffness, within fixed ones.
Scene stressed_scene(const Vec3& stress) {
  Scene scene = slope_scene(0, 60);
  scene.analysis.mode = Mode::statics;
  scene.analysis.steps = 10;
  scene.analysis.gravity.setZero();
  scene.joints[0].normal_stiffness = joint_stiffness;
  scene.joints[0].shear_stiffness = joint_stiffness / 2;
  scene.blocks = {block(rectangle(-1, -1, 8, 1), true), block(rectangle(-1, 2, 8, 1), true),
                  block(rectangle(-1, 0, 1, 2), true), block(rectangle(6, 0, 1, 2), true)};
  for (const std::initializer_list<double> corners :
       {std::initializer_list<double>{0, 0, 2, 0, 3, 2, 0, 2}, {2, 0, 6, 0, 6, 2, 3, 2}})
    scene.blocks.push_back(block(Eigen::Map<const Points>(corners.begin(), 2, 4)));
  for (BlockDescription& of : scene.blocks) of.stress = stress;
  return scene;
}

double furthest(const Stepper& stepper) {
  return stepper.blocks().displacements(stepper.state()).cwiseAbs().maxCoeff();
}

}  // namespace

/// What is in balance stays as it is: the inclined joint bears the normal and the shear stress of the field.
TEST(FirstContacts, JointsBearTheStressThatTheirBlocksBeginWith) {
  const Vec3 stress(-10e6, -6e6, 1e6);
  for (const BlockModel model : {BlockModel::affine, BlockModel::wachspress, BlockModel::mesh})
    for (const Mode mode : {Mode::statics, Mode::dynamic}) {
      Scene scene = stressed_scene(stress);
      scene.analysis.mode = mode;
      for (BlockDescription& of : scene.blocks) of.model = model;
      const BuiltScene built = run(scene);
      const Stepper& stepper = *built.stepper;
      EXPECT_LT(furthest(stepper), 1e-10);
      for (const int b : {4, 5}) {
        const Tensors now = stepper.blocks().block(b).stress(stepper.state());
        EXPECT_LT((now.colwise() - stress).cwiseAbs().maxCoeff(), 1e-6 * 10e6);
      }
      ddacontact::ContactForce sum{0, 0};
      for (const ddacontact::ContactRecord& contact : stepper.contacts())
        if (contact.pair.vertex_block >= 4 && contact.pair.edge_block >= 4) {
          sum.normal += contact.history.normal;
          sum.shear += contact.history.shear;
        }
      const Vec2 along(1 / std::sqrt(5), 2 / std::sqrt(5)), normal(along.y(), -along.x()),
          traction(stress[0] * normal.x() + stress[2] * normal.y(),
                   stress[2] * normal.x() + stress[1] * normal.y());
      EXPECT_NEAR(sum.normal, -std::sqrt(5) * traction.dot(normal), 1);
      EXPECT_NEAR(std::abs(sum.shear), std::sqrt(5) * std::abs(traction.dot(along)), 1);
    }
}

/// Where supports lead a block at all of its vertices its joints still begin with its stress, and keep what
/// they bear once it stands.
TEST(FirstContacts, JointsBearTheStressOfABlockThatSupportsLead) {
  const double pressure = 1e6, closure = 1e-4;
  for (const BlockModel model : {BlockModel::affine, BlockModel::mean_value, BlockModel::mesh}) {
    Scene scene = stressed_scene({0, -pressure, 0});
    scene.blocks = {block(rectangle(-1, -1, 3, 1), true), block(rectangle(0, 0, 1, 1))};
    for (BlockDescription& of : scene.blocks) of.stress = {0, -pressure, 0};
    scene.blocks[1].model = model;
    scene.supports = {
        {1,
         {0, 1, 2, 3},
         true,
         true,
         {TimeFunction::Kind::history, {0, 0}, {{0, 0, 0}, {0.05, 0, -closure}, {1, 0, -closure}}}}};
    const BuiltScene built = run(scene);
    double normal = 0;
    for (const ddacontact::ContactRecord& contact : built.stepper->contacts()) normal += contact.normal;
    EXPECT_NEAR(normal, pressure + joint_stiffness * closure, 0.01 * pressure) << static_cast<int>(model);
  }
}

/// A bar between two walls, one of which is taken out: the bar and its joint expand.
TEST(FirstContacts, AJointThatIsRelievedOpensByItsStressOverItsStiffness) {
  const double sigma = 5e6, length = 4;
  Scene scene = slope_scene(0, 30);
  scene.analysis.mode = Mode::statics;
  scene.analysis.steps = 30;
  scene.analysis.gravity.setZero();
  scene.materials[0].poisson = 0;
  scene.joints[0].normal_stiffness = joint_stiffness;
  scene.joints[0].shear_stiffness = joint_stiffness;
  scene.blocks = {block(rectangle(-1, 0, 1, 1), true), block(rectangle(length, 0, 1, 1), true),
                  block(rectangle(0, 0, length, 1))};
  for (BlockDescription& of : scene.blocks) of.stress = {-sigma, 0, 0};
  scene.stages = {scene.stage("before"), scene.stage("after")};
  scene.stages[0].analysis.steps = 2;
  scene.stages[1].removed = {1};
  BuiltScene built = build(scene);
  run(*built.stepper, 32);
  const Points moved = built.stepper->blocks().displacements(built.stepper->state()).rightCols(4);
  const double by_joint = sigma / joint_stiffness, by_bar = sigma / 35e9 * length;
  EXPECT_NEAR(moved(0, 0), by_joint, 1e-3 * by_joint);
  EXPECT_NEAR(moved(0, 1), by_joint + by_bar, 1e-3 * by_joint);
}

/// Under a slab that has sunk by more than what touches at the start of a run.
TEST(FirstContacts, TensionHoldsABlockThatComesInUnderOneThatHasMoved) {
  for (const double strength : {0., 1e6}) {
    Scene scene = beam_scene();
    scene.analysis.mode = Mode::statics;
    scene.materials.push_back({"soft", 2500, 2e9, 0.3});
    scene.blocks[1].material = scene.blocks[2].material = 1;
    scene.blocks.push_back(block(rectangle(2, 0.5, 1, 0.5)));
    scene.joints[0].tensile_strength = strength;
    scene.joints[0].cohesion = strength;
    scene.stages = {scene.stage("slab"), scene.stage("hung")};
    scene.stages[0].analysis.steps = scene.stages[1].analysis.steps = 20;
    scene.stages[1].added = {4};
    BuiltScene built = build(scene);
    run(*built.stepper, 20);
    const double sunk = travel(*built.stepper, 3).y();
    EXPECT_LT(sunk, -10e-6);
    run(*built.stepper, 20);
    const double fallen = travel(*built.stepper, 4).y();
    EXPECT_EQ(fallen > -20e-6, strength > 0) << fallen;
    EXPECT_EQ(fallen < -1e-3, strength == 0) << fallen;
  }
}

/// A prop drawn to fit under a slab that has sunk by then fits: it is neither squeezed nor loose. On columns
/// of 200 MPa the slab has sunk by more than what joints are flush to.
TEST(FirstContacts, ABlockThatComesInFitsAndBearsNothingOfWhatWasBorneBefore) {
  for (const double young : {2e9, 2e8}) {
    Scene scene = beam_scene();
    scene.analysis.mode = Mode::statics;
    scene.materials.push_back({"soft", 2500, young, 0.3});
    scene.blocks[1].material = scene.blocks[2].material = 1;
    scene.blocks.push_back(block(rectangle(2, 0, 1, 1)));
    scene.stages = {scene.stage("slab"), scene.stage("propped"), scene.stage("loaded")};
    for (StageDescription& stage : scene.stages) stage.analysis.steps = 30;
    scene.stages[1].added = {4};
    scene.loads = {point_load(3, Vec2(2.5, 2), constant({0, -100e3}))};
    scene.stages[2].loads = {0};
    BuiltScene built = build(scene);
    run(*built.stepper, 30);
    const double sunk = travel(*built.stepper, 3).y();
    run(*built.stepper, 30);
    EXPECT_NEAR(travel(*built.stepper, 3).y(), sunk, 1e-2 * std::abs(sunk));
    run(*built.stepper, 30);
    double on_prop = 0;
    for (const ddacontact::ContactRecord& contact : built.stepper->contacts())
      if (contact.pair.vertex_block + contact.pair.edge_block == 4 + 3) on_prop += contact.normal;
    const double stiffer = 35e9 / young;
    EXPECT_NEAR(on_prop, 100e3 * stiffer / (stiffer + 2), 5e3);
  }
}

/// As deep as scenes may state it, flush on both sides too: there is no corner that could pass the other
/// block.
TEST(FirstContacts, BlocksThatBeginWithAnOverlapRestOnEachOther) {
  for (const BlockModel model : {BlockModel::affine, BlockModel::wachspress, BlockModel::mesh})
    for (const double overlap : {5e-5, 1.5e-4, 9e-4})
      for (const double aside : {0., 5e-5, 0.3}) {
        Scene scene = slope_scene(0, 30);
        scene.blocks = {block(rectangle(0, -1, 1, 1), true), block(rectangle(aside, -overlap, 1, 1)),
                        block(rectangle(aside, 1 - 2 * overlap, 1, 1))};
        for (BlockDescription& of : scene.blocks) of.model = model;
        const BuiltScene built = run(scene);
        for (const int b : {1, 2})
          EXPECT_NEAR(travel(*built.stepper, b).norm(), 0, 1e-5) << overlap << ' ' << aside;
      }
}

/// Steps within the lip of a joint are no overlap: the block stands before the riser, not on it.
TEST(FirstContacts, ABlockBesideARiserIsHeldByIt) {
  Scene scene = slope_scene(0, 0);
  scene.analysis.mode = Mode::statics;
  const double corners[] = {-5, -1, 5, -1, 5, 0, 0, 0, 0, 5e-4, -5, 5e-4};
  scene.blocks = {block(Eigen::Map<const Points>(corners, 2, 6), true), block(rectangle(0, 0, 1, 1))};
  scene.blocks[0].model = BlockModel::mean_value;
  scene.loads = {body_load(1, constant({-10e3, 0}))};
  const BuiltScene built = run(scene);
  EXPECT_NEAR(travel(*built.stepper, 1).norm(), 0, 1e-5);
}

/// A load that lifts the slab off its prop and puts it back, on columns that have shortened by 0.3 mm before.
TEST(FirstContacts, ALoadCycleEndsWhereItBegan) {
  Scene scene = beam_scene();
  scene.analysis.mode = Mode::statics;
  scene.materials.push_back({"soft", 2500, 2e8, 0});
  scene.blocks[1].material = scene.blocks[2].material = 1;
  scene.blocks.push_back(block(rectangle(2, 0, 1, 1)));
  scene.stages = {scene.stage("slab"), scene.stage("propped")};
  scene.stages[0].analysis.steps = 30;
  scene.stages[1].analysis.steps = 150;
  scene.stages[1].added = {4};
  const double start = 40 * scene.analysis.time_step, end = 140 * scene.analysis.time_step;
  scene.loads = {
      point_load(3, Vec2(2.5, 1.5),
                 ddacontact::history_function(TimeFunction::Kind::history,
                                              {{start, 0, 0}, {(start + end) / 2, 0, 60e3}, {end, 0, 0}}))};
  BuiltScene built = build(scene);
  run(*built.stepper, 38);
  const double before = travel(*built.stepper, 3).y();
  run(*built.stepper, 52);
  EXPECT_GT(travel(*built.stepper, 3).y(), before + 1e-4);
  run(*built.stepper, 90);
  EXPECT_NEAR(travel(*built.stepper, 3).y(), before, 2e-6);
}

/// Corners of a triangle cut off by a joint between meshes are found where the joint has closed to.
TEST(FirstContacts, MeshesCutAtACornerBearTheStress) {
  const double p = 2e6;
  Scene scene = slope_scene(0, 40);
  scene.analysis.mode = Mode::statics;
  scene.analysis.steps = 10;
  scene.analysis.gravity.setZero();
  scene.materials = {{"rock", 2500, 5e9, 0.25}};
  scene.joints[0].normal_stiffness = 2e10;
  scene.joints[0].shear_stiffness = 8e9;
  const double big[] = {0, 0, 4, 0, 4, 4, 0.14, 4, 0, 3.66}, tri[] = {0, 3.66, 0.14, 4, 0, 4};
  scene.blocks = {block(Eigen::Map<const Points>(big, 2, 5)), block(Eigen::Map<const Points>(tri, 2, 3))};
  for (BlockDescription& of : scene.blocks) {
    of.model = BlockModel::mesh;
    of.stress = {-p, -p, 0};
  }
  scene.supports = {{0, {0, 1}, false, true, {}}, {0, {2, 3}, false, true, {}}, {0, {0, 4}, true, false, {}},
                    {0, {1, 2}, true, false, {}}, {1, {1, 2}, false, true, {}}, {1, {0, 2}, true, false, {}}};
  const BuiltScene built = run(scene);
  double force = 0;
  for (const ddacontact::ContactRecord& contact : built.stepper->contacts()) force += contact.normal;
  EXPECT_NEAR(force, p * std::hypot(0.14, 0.34), 1e-3 * p);
}
