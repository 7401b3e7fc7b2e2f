// Concave blocks and blocks with vertices on straight edges rest, slide, wedge and collide.
#include <tests/ddacontact/simple_scenes.hpp>
#include <tests/support/hard_steps.hpp>
#include <tests/support/random_shapes.hpp>

#include <gtest/gtest.h>

using namespace support;

namespace {

/// The default mechanics, friction as given, rock of 10 GPa, gravity 10 m/s2.
Scene shapes_scene(double friction_angle, double time_step) {
  Scene scene;
  scene.analysis.time_step = time_step;
  scene.analysis.gravity = Vec2(0, -10);
  scene = default_mechanics(scene);
  scene.analysis.cutting_factor = 0.5;
  scene.contact.normal_stiffness = 4e11;
  scene.contact.tangential_stiffness = 1.6e11;
  scene.materials = {{"rock", 2500, 1e10, 0.25}};
  scene.joints = {{"joint", friction_angle, 0, 0, std::nullopt}};
  return scene;
}

void add(Scene& scene, const Points& outline, bool fixed = false, const Vec2& velocity = Vec2(0, 0)) {
  BlockDescription b = block(outline, fixed);
  b.model = BlockModel::affine;
  b.velocity = velocity;
  scene.blocks.push_back(b);
}

Points shifted(const Points& polygon, double x, double y) {
  return polygon.colwise() + Vec2(x, y);
}

const Points l_shape = points({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});

/// From where the model has its origin to where the scene has it.
Vec2 scene_origin(const Scene& scene, const Stepper& stepper) {
  return stepper.blocks().reference().col(0) - scene.blocks[0].vertices.col(0);
}

/// Of the centroid, as in the scene.
Vec2 point(const Scene& scene, const BuiltScene& built, int b) {
  return centre(*built.stepper, b) - scene_origin(scene, *built.stepper);
}

/// Runs and looks at overlaps all along.
BuiltScene run_apart(const Scene& scene, int steps) {
  BuiltScene built = build(scene);
  for (int k = 0; k < steps; ++k) {
    const bool made = built.stepper->step();
    EXPECT_TRUE(made) << "step " << k << ": " << built.stepper->stop_reason();
    if (!made) break;
    if (k % 5 == 0) {
      EXPECT_LE(largest_overlap(*built.stepper), 1e-4) << "step " << k;
    }
  }
  return built;
}

}  // namespace

TEST(AnyShape, AnLComesToRestOnAFloorOnEitherSide) {
  for (const int quarter_turns : {0, 1, 2, 3}) {
    Scene scene = shapes_scene(30, 5e-3);
    add(scene, rectangle(-20, -2, 40, 2), true);
    const Points turned_l = turned(l_shape, quarter_turns * std::numbers::pi / 2);
    add(scene, shifted(turned_l, 0, 0.01 - turned_l.row(1).minCoeff()));
    const BuiltScene built = run_apart(scene, 400);
    const Points outline = built.stepper->blocks().positions(built.stepper->state()).rightCols(6);
    const double low = outline.row(1).minCoeff() - scene_origin(scene, *built.stepper).y();
    EXPECT_NEAR(low, 0, 1e-5) << quarter_turns;
    EXPECT_LE(built.stepper->energy().now.kinetic, 1e-6) << quarter_turns;
  }
}

TEST(AnyShape, ASquareSettlesInANotchAndStays) {
  for (const double friction : {0., 30.}) {
    Scene scene = shapes_scene(friction, 5e-3);
    // The notch points downwards: its sides rise at 45 degrees from the origin.
    add(scene, turned(points({{-3, -3}, {4, -3}, {4, 0}, {0, 0}, {0, 4}, {-3, 4}}), std::numbers::pi / 4),
        true);
    add(scene, shifted(turned(rectangle(0, 0, 1, 1), std::numbers::pi / 4 + 0.02), 0.02, 0.06));
    const BuiltScene built = run_apart(scene, 600);
    EXPECT_NEAR(point(scene, built, 1).x(), 0, friction == 0 ? 1e-4 : 2e-2);
    EXPECT_NEAR(point(scene, built, 1).y(), std::sqrt(0.5), friction == 0 ? 1e-4 : 2e-2);
  }
}

TEST(AnyShape, ADartSlidesDownASlopeAsAnythingDoes) {
  const double angle = radians(20);
  Scene scene = shapes_scene(0, 5e-3);
  add(scene, turned(rectangle(-40, -2, 80, 2), angle), true);
  add(scene, turned(points({{0, 0}, {2, 0}, {2, 2}, {1.2, 0.8}}), angle));
  const BuiltScene built = run_apart(scene, 200);
  EXPECT_NEAR(travel(*built.stepper, 1).norm(), 10 * std::sin(angle) / 2, 1e-3);
}

/// Vertices on the sides of the blocks and of the floor change nothing in a motion where they touch along.
TEST(AnyShape, VerticesOnStraightSidesChangeNothingThatIsRigid) {
  std::mt19937 random(5);
  const auto travelled = [&](bool with_vertices) {
    Scene scene = shapes_scene(25, 5e-3);
    const Points round_off = turned(rectangle(-20, -2, 40, 2), radians(30)),
                 box = turned(rectangle(0, 0, 2, 1), radians(30));
    add(scene,
        with_vertices ? with_straight_vertices(with_straight_vertices(round_off, 1, random), 1, random)
                      : round_off,
        true);
    add(scene, with_vertices ? with_straight_vertices(box, 1, random) : box);
    return travel(*run_apart(scene, 200).stepper, 1);
  };
  const Vec2 plain = travelled(false), with = travelled(true);
  EXPECT_GT(plain.norm(), 0.3);
  EXPECT_LE((plain - with).norm(), 1e-5);
}

/// Two boxes side by side and one on both: corners on a side, and a side over the joint.
TEST(AnyShape, ATJointHolds) {
  Scene scene = shapes_scene(30, 5e-3);
  add(scene, rectangle(-20, -2, 40, 2), true);
  add(scene, rectangle(-1, 0, 1, 1));
  add(scene, rectangle(0, 0, 1, 1));
  add(scene, shifted(points({{0, 0}, {0.5, 0}, {1, 0}, {1, 1}, {0, 1}}), -0.5, 1));
  const BuiltScene built = run_apart(scene, 300);
  EXPECT_LE(travel(*built.stepper, 3).norm(), 1e-4);
  EXPECT_LE(built.stepper->energy().now.kinetic, 1e-8);
}

/// Small fast blocks of any shape against thin long and concave ones: none gets through.
TEST(AnyShape, NothingPassesThroughAnything) {
  std::mt19937 random(9);
  for (int trial = 0; trial < 12; ++trial) {
    SCOPED_TRACE(trial);
    Scene scene = shapes_scene(trial % 2 ? 20 : 0, 5e-3);
    scene.joints[0].restitution = trial % 3 == 0 ? 0.5 : 0;
    // A closed box of thin walls, as two concave halves, with a comb for a floor.
    add(scene,
        points({{-4, 6},
                {-4, -0.1},
                {4, -0.1},
                {4, 6},
                {3.9, 6},
                {3.9, 0},
                {1.5, 0},
                {1.4, 0.8},
                {1.3, 0},
                {-1, 0},
                {-1, 0.6},
                {-1.1, 0.6},
                {-1.1, 0},
                {-3.9, 0},
                {-3.9, 6}}),
        true);
    for (int k = 0; k < 6; ++k) {
      const double size = 0.6 * std::pow(10, -uniform(0, 1, random));
      const Vec2 point(-3 + 1.2 * k, uniform(1.6, 4, random));
      add(scene, (size * random_shape(random)).colwise() + point, false,
          uniform(0, 15, random) * random_direction(random));
      scene.blocks.back().angular_velocity = uniform(-10, 10, random);
    }
    const BuiltScene built = run_apart(scene, 120);
    for (int b = 1; b < 7; ++b) {
      const Vec2 x = point(scene, built, b);
      if (x.y() > 6) continue;  // out at the top
      EXPECT_GT(x.y(), 0) << b;
      EXPECT_LT(std::abs(x.x()), 3.9) << b;
    }
  }
}

/// Round blocks of many vertices under a load on top are about as stiff as by mean value functions;
/// four points a triangle left a hundredth of that with 30 vertices.
TEST(RoundBlock, IsAsStiffAsMeanValueFunctionsHaveIt) {
  for (const int n : {8, 16, 24, 30, 48}) {
    const auto settlement = [&](BlockModel model) {
      Scene scene = shapes_scene(0, 0.1);
      scene.analysis.mode = Mode::statics;
      scene.analysis.steps = 40;
      Points disk(2, n);
      for (int k = 0; k < n; ++k) {
        const double angle = 2 * std::numbers::pi * (k + 0.5) / n - std::numbers::pi / 2;
        disk.col(k) << std::cos(angle), 1 + std::sin(angle);
      }
      disk.row(1).array() -= disk.row(1).minCoeff();
      add(scene, rectangle(-2, -1, 4, 1), true);
      add(scene, disk);
      scene.blocks[1].model = model;
      scene.loads = {point_load(1, Vec2(0, disk.row(1).maxCoeff()), constant({0, -1e5}))};
      const BuiltScene built = run(scene);
      return -built.stepper->blocks().displacements(built.stepper->state()).row(1).minCoeff();
    };
    const double by_mean_value = settlement(BlockModel::mean_value);
    const double ratio = settlement(BlockModel::wachspress) / by_mean_value;
    EXPECT_GT(ratio, 0.6) << n;
    EXPECT_LT(ratio, 1.2) << n;
  }
}
