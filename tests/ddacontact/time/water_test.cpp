// Water at rest on faces, against hydrostatics and against the formulas of slopes and dams.
#include <tests/ddacontact/simple_scenes.hpp>

using namespace support;

namespace {

constexpr double unit_weight_of_water = 1e4;  // N/m3

Points line(std::initializer_list<Vec2> points) {
  Points result(2, static_cast<Index>(points.size()));
  Index k = 0;
  for (const Vec2& point : points) result.col(k++) = point;
  return result;
}

/// Rock under the default mechanics, water of the table in joints too.
Scene wet_scene(double time_step, int steps, const Points& table) {
  Scene scene = default_mechanics(rock_scene(time_step, steps));
  scene.analysis.block_model = BlockModel::affine;
  scene.materials[0].young = 1e11;
  scene.contact.normal_stiffness = 4e12;
  scene.contact.tangential_stiffness = 1.6e12;
  scene.water = {table, table, 1000};
  return scene;
}

Vec2 force_on(const Stepper& stepper, int b) {
  Vec2 sum = Vec2::Zero();
  for (const ddacontact::ContactRecord& contact : stepper.contacts()) {
    if (!contact.closed()) continue;
    const Points x = stepper.blocks().positions(stepper.state());
    const auto [first, count] = stepper.blocks().block(contact.pair.edge_block).vertices();
    const Vec2 along =
        (x.col(first + (contact.pair.edge + 1) % count) - x.col(first + contact.pair.edge)).normalized();
    const Vec2 on_vertex = contact.normal * Vec2(along.y(), -along.x()) + contact.shear * along;
    if (contact.pair.vertex_block == b) sum += on_vertex;
    if (contact.pair.edge_block == b) sum -= on_vertex;
  }
  return sum;
}

/// Of the wedge on a plane with a crack full of water behind it: Hoek and Bray's formula.
struct PlaneFailure {
  double dip = radians(35), length = 20, crack = 8;  // m along the plane, m of water in the crack

  /// Corners: toe, foot of the crack, its top, the crest.
  Points wedge() const {
    const Vec2 foot = length * Vec2(std::cos(dip), std::sin(dip));
    return line({{0, 0}, foot, foot + Vec2(0, crack), Vec2(5, foot.y() + crack)});
  }
  Points ground() const {
    const Vec2 foot = wedge().col(1);
    return line({{0, -5}, {30, -5}, {30, foot.y() + crack}, foot + Vec2(0, crack), foot, {0, 0}});
  }
  /// The head falls along the plane from the crack's to none at the toe.
  Points table() const {
    const Vec2 foot = wedge().col(1);
    return line({{0, 0}, foot + Vec2(0, crack)});
  }
  double tangent_at_the_limit(double weight) const {
    const double along_crack = unit_weight_of_water * crack * crack / 2,
                 uplift = unit_weight_of_water * crack * length / 2;
    return (weight * std::sin(dip) + along_crack * std::cos(dip)) /
           (weight * std::cos(dip) - uplift - along_crack * std::sin(dip));
  }
};

}  // namespace

TEST(Water, OfALevelTableCarriesWhatItDisplaces) {
  for (const double depth : {0.0, 0.5, 3.0}) {  // above the top; the block is 1 m high
    Scene scene = wet_scene(0.01, 100, line({{0, 1 + depth}}));
    scene.analysis.mode = Mode::statics;
    scene.blocks = {block(rectangle(-1, -1, 4, 1), true), block(rectangle(0, 0, 2, 1))};
    const BuiltScene built = run(scene);
    EXPECT_NEAR(force_on(*built.stepper, 1).y(), 2 * (2e4 - unit_weight_of_water), 0.02) << depth;
    EXPECT_NEAR(force_on(*built.stepper, 1).x(), 0, 1e-3);
  }
}

TEST(Water, OnOuterFacesAlonePressesABlockDown) {
  Scene scene = wet_scene(0.01, 100, line({{0, 4}}));
  scene.water.joint_table.resize(2, 0);
  scene.analysis.mode = Mode::statics;
  scene.blocks = {block(rectangle(-1, -1, 4, 1), true), block(rectangle(0, 0, 2, 1))};
  const BuiltScene built = run(scene);
  EXPECT_NEAR(force_on(*built.stepper, 1).y(), 2 * (2e4 + 3 * unit_weight_of_water), 0.1);
}

/// A float of half the density of water bobs with the frequency of its water plane.
TEST(Water, AFloatBobs) {
  Scene scene = wet_scene(1e-3, 0, line({{0, 0}}));
  scene.materials[0].density = 500;
  scene.blocks = {block(rectangle(0, -0.95, 4, 2))};  // 5 cm too high
  const double omega = std::sqrt(unit_weight_of_water * 4 / (500 * 4 * 2));
  scene.analysis.steps = static_cast<int>(std::round(std::numbers::pi / omega / 1e-3));
  const BuiltScene built = run(scene);
  EXPECT_NEAR(travel(*built.stepper, 0).y(), -0.1, 1e-4);
  EXPECT_NEAR(travel(*built.stepper, 0).x(), 0, 1e-12);
}

/// Pressures act on the predicted shape: on that of the start of each step the amplitude grew threefold.
TEST(Water, AFloatBobsForEverWithoutNumericalDamping) {
  for (const auto& [scheme, error] : {std::pair{Scheme::midpoint, 1e-5}, {Scheme::newmark, 3e-3}}) {
    Scene scene = wet_scene(0.01, 0, line({{0, 0}}));
    scene.analysis.scheme = scheme;
    scene.analysis.gamma = 0.5;
    scene.analysis.beta = 0.25;
    scene.materials[0].density = 500;
    scene.blocks = {block(rectangle(0, -0.95, 4, 2))};
    const double omega = std::sqrt(unit_weight_of_water * 4 / (500 * 4 * 2));
    const int period = static_cast<int>(std::round(2 * std::numbers::pi / omega / 0.01));
    scene.analysis.steps = 10 * period;
    const BuiltScene built = build(scene);
    for (int n = 0; n < 9 * period; ++n) ASSERT_TRUE(built.stepper->step());
    double lowest = 0;
    for (int n = 0; n < period; ++n) {
      ASSERT_TRUE(built.stepper->step());
      lowest = std::min(lowest, travel(*built.stepper, 0).y());
    }
    EXPECT_NEAR(lowest, -0.1, error) << static_cast<int>(scheme);
  }
}

TEST(Water, IsNotedWhereItsTableFallsSteeplyBesideAFace) {
  const auto notes = [](double fall) {
    Scene scene = wet_scene(0.01, 1, line({{-10, 3.5}, {fall, 3.5}, {fall + 0.01, 0}, {20, 0}}));
    scene.water.joint_table.resize(2, 0);
    scene.blocks = {block(rectangle(-10, -2, 30, 2), true), block(rectangle(0, 0, 2, 4))};
    int n = 0;
    for (const std::string& note : build(scene).notes)
      n += note.find("falls steeply beside block") != std::string::npos;
    return n;
  };
  EXPECT_EQ(notes(0), 1);
  EXPECT_EQ(notes(1), 0);
}

TEST(Water, InACrackBehindAWedgeDecidesWhetherItSlides) {
  const PlaneFailure plane;
  for (const double part : {0.995, 1.005}) {
    Scene scene = wet_scene(0.01, 100, plane.table());
    scene.blocks = {block(plane.ground(), true), block(plane.wedge())};
    for (BlockDescription& one : scene.blocks) one.model = BlockModel::affine;
    const double weight = 2e4 * polyfem::area_moments(plane.wedge()).area,
                 tangent = plane.tangent_at_the_limit(weight);
    scene.joints[0].friction_angle = std::atan(part * tangent) * 180 / std::numbers::pi;
    const BuiltScene built = run(scene);
    const double along = travel(*built.stepper, 1).norm();
    // Sliding for a second it would go about 2.7 cm.
    if (part < 1)
      EXPECT_GT(along, 0.01);
    else
      EXPECT_LT(along, 1e-3);
  }
}

TEST(Water, LeftOutOfJointsThatOpenWhenTheirNeighbourIsTakenOut) {
  Scene scene = wet_scene(0.01, 0, line({{0, 4}}));
  scene.water.joint_table.resize(2, 0);
  scene.blocks = {block(rectangle(-1, -1, 6, 1), true), block(rectangle(0, 0, 1, 1)),
                  block(rectangle(1, 0, 1, 1), true)};
  scene.joints[0].friction_angle = 60;
  ddacontact::StageDescription settle = scene.stage("settle"), open = scene.stage("open");
  settle.analysis.mode = open.analysis.mode = Mode::statics;
  settle.analysis.steps = open.analysis.steps = 20;
  open.removed = {2};
  scene.stages = {settle, open};
  BuiltScene built = build(scene);
  run(*built.stepper, 20);
  // Water pushes from the left alone: 3.5 m of it over 1 m.
  EXPECT_NEAR(force_on(*built.stepper, 1).x(), -3.5 * unit_weight_of_water, 0.05);
  run(*built.stepper, 20);
  EXPECT_NEAR(force_on(*built.stepper, 1).x(), 0, 1e-3);
}

TEST(Water, ChangesWithTheStage) {
  Scene scene = wet_scene(0.01, 0, line({{0, 4}}));
  scene.blocks = {block(rectangle(-1, -1, 4, 1), true), block(rectangle(0, 0, 2, 1))};
  ddacontact::StageDescription wet = scene.stage("wet"), dry = scene.stage("dry");
  wet.analysis.mode = dry.analysis.mode = Mode::statics;
  wet.analysis.steps = dry.analysis.steps = 10;
  dry.water = {};
  scene.stages = {wet, dry};
  BuiltScene built = build(scene);
  run(*built.stepper, 10);
  EXPECT_NEAR(force_on(*built.stepper, 1).y(), 2e4, 0.02);
  run(*built.stepper, 10);
  EXPECT_NEAR(force_on(*built.stepper, 1).y(), 4e4, 0.02);
}
