#include <tests/ddacontact/simple_scenes.hpp>

using namespace support;

namespace {

/// Stacks of three that fall apart from each other, on one ground, and two blocks in flight.
Scene falling_stacks(int n) {
  Scene scene;
  scene.analysis.time_step = 0.005;
  scene.analysis.steps = 40;
  scene.analysis.max_displacement_ratio = 1;
  scene.materials = {{"rock", 2500, 10e9, 0.2}};
  scene.joints = {{"joint", 35, 0, 0, std::nullopt}};
  scene.contact.normal_stiffness = 40 * 10e9;
  scene.contact.tangential_stiffness = 16 * 10e9;
  scene.blocks = {block(rectangle(-5, -1, 6.0 * n + 10, 1), true)};
  for (int k = 0; k < n; ++k)
    for (int level = 0; level < 3; ++level) {
      scene.blocks.push_back(block(rectangle(6 * k + 0.1 * ((k * level) % 3), 1.02 * level, 1, 1)));
      scene.blocks.back().velocity = Vec2(0.2 * k, 0);
    }
  for (int k : {0, 1}) scene.blocks.push_back(block(rectangle(2 + 6 * k, 10, 1, 1)));
  for (BlockDescription& b : scene.blocks) b.model = BlockModel::wachspress;
  return scene;
}

Scene together(Scene scene) {
  scene.analysis.skip.islands = false;
  return scene;
}

}  // namespace

TEST(IslandsApart, MoveAsTheyDoTogether) {
  Scene scene = falling_stacks(4);
  scene.contact.penetration_tolerance = 1e-8;
  BuiltScene apart = build(scene), one = build(together(scene));
  double weight = 0;
  for (int b = 0; b < apart.stepper->blocks().n_blocks(); ++b)
    weight += 9.8 * apart.stepper->blocks().block(b).mass_total();
  for (int k = 0; k < scene.analysis.steps; ++k) {
    run(*apart.stepper, 1);
    run(*one.stepper, 1);
    const Points difference = apart.stepper->state().position - one.stepper->state().position;
    ASSERT_LE(difference.cwiseAbs().maxCoeff(), 1e-7) << k;
    ASSERT_LE((apart.stepper->reactions() - one.stepper->reactions()).rowwise().sum().norm(), 1e-2 * weight)
        << k;
  }
  EXPECT_LT(apart.stepper->counts().contact_iterations, one.stepper->counts().contact_iterations);
  EXPECT_LE(apart.stepper->counts().max_residual, 1e-8);
  EXPECT_LE(std::abs(apart.stepper->energy().balance_error()), 1e-8);
}

/// Blocks whose matrices follow their shape: islands have those of the whole, in steps with impacts too, from a
/// start that is not the shape.
TEST(IslandsApart, HaveTheMatricesOfBlocksThatFollowTheirShape) {
  Scene scene = falling_stacks(3);
  scene.contact.method = ContactMethod::staged;
  scene.contact.penetration_tolerance = 1e-8;
  scene.analysis.kinematics = Kinematics::incremental;
  scene.analysis.scheme = Scheme::dda;
  for (std::size_t b = 1; b < scene.blocks.size(); ++b) {
    scene.blocks[b].model = b % 2 == 0 ? BlockModel::affine : BlockModel::wachspress;
    scene.blocks[b].angular_velocity = 3;
  }
  BuiltScene apart = build(scene), one = build(together(scene));
  run(*apart.stepper, 20);
  run(*one.stepper, 20);
  EXPECT_GT(apart.stepper->counts().impacts, 0);
  const Points difference = apart.stepper->state().position - one.stepper->state().position;
  EXPECT_LE(difference.cwiseAbs().maxCoeff(), 1e-5) << "with matrices of the start 5e-4";
}

/// Each converges as it does when there is no other.
TEST(IslandsApart, TakeWhatTheOneTakesThatNeedsMost) {
  Scene scene = falling_stacks(3);
  scene.analysis.steps = 1;
  BuiltScene all = build(scene);
  run(*all.stepper, 1);
  long most = 0;
  for (int k = 0; k < 3; ++k) {
    Scene alone = scene;
    alone.blocks = {scene.blocks[0]};
    for (int level = 0; level < 3; ++level) alone.blocks.push_back(scene.blocks[1 + 3 * k + level]);
    BuiltScene one = build(alone);
    run(*one.stepper, 1);
    most = std::max(most, one.stepper->counts().contact_iterations);
  }
  EXPECT_EQ(all.stepper->counts().contact_iterations, most);
}
