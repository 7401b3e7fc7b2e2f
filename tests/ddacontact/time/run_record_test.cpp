// Scenes drawn by lot, run in stages drawn by lot: what is carried on is all that a step depends on.

#include <ddacontact/scene/builder.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <tests/support/any_drops.hpp>
#include <tests/support/random_scenes.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace ddacontact;
using namespace support;

namespace {

/// Three to five stages of a few steps: other steps, schemes, modes, joints, blocks. Forces of blocks taken
/// out may decrease, and a block and a load may come in later.
void divide_into_stages(Scene& scene, std::mt19937& random) {
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const int n_stages = 3 + below(3);
  Load load{"",
            Load::Kind::body,
            static_cast<int>(scene.blocks.size()) - 1,
            Vec2::Zero(),
            0,
            {TimeFunction::Kind::constant, {2e3, 1e3}, {}}};
  load.force.rise = 0.01;
  scene.loads = {load};
  std::vector<int> left(scene.blocks.size());
  for (std::size_t b = 0; b < left.size(); ++b) left[b] = static_cast<int>(b);
  for (int k = 0; k < n_stages; ++k) {
    StageDescription stage = scene.stage("");
    stage.analysis.steps = 1 + below(5);
    stage.analysis.time_step *= std::ldexp(1.0, below(3) - 1);
    if (below(5) == 0) stage.analysis.mode = Mode::statics;
    const Scheme schemes[] = {Scheme::decaying, Scheme::midpoint,       Scheme::dda,
                              Scheme::newmark,  Scheme::backward_euler, Scheme::central_difference};
    if (below(3) == 0 && scene.analysis.kinematics == Kinematics::corotational)
      stage.analysis.scheme = schemes[below(6)];
    if (below(3) == 0) stage.analysis.gravity = Vec2(below(10) - 5, -below(10));
    if (below(3) == 0)
      stage.joints[0] = {"", 80.0 * below(2), 1e4 * below(2), 1e4 * below(2), stage.joints[0].between};
    stage.reset_displacements = below(3) == 0;
    if (below(3) == 0 && left.size() > 2) {
      const int b = below(static_cast<int>(left.size()));
      stage.removed.push_back(left[static_cast<std::size_t>(b)]);
      left.erase(left.begin() + b);
      if (k > 0 && below(2) == 0) stage.relax = 1 + below(stage.analysis.steps);
    }
    if (k == 1 && below(2) == 0) stage.loads = {0};
    if (k == 1 && below(2) == 0 && scene.bolts.empty()) stage.added = {left.back()};
    scene.stages.push_back(stage);
  }
}

/// A bolt through the last two blocks that soon yields, and one that is drawn out of them.
void bolt_together(Scene& scene) {
  const std::size_t n = scene.blocks.size();
  RockBolt bolt;
  bolt.from = polyfem::area_moments(scene.blocks[n - 2].vertices).centroid;
  const polyfem::AreaMoments last = polyfem::area_moments(scene.blocks[n - 1].vertices);
  bolt.to = last.centroid;
  const double weight = 10 * scene.materials[0].density * last.area, length = (bolt.to - bolt.from).norm();
  bolt.name = "anchored";
  bolt.area = 1e-4 * last.area;
  bolt.young = 2e11;
  bolt.yield_force = 0.1 * weight;
  scene.bolts = {bolt, bolt};
  scene.bolts[1].name = "grouted";
  scene.bolts[1].kind = RockBolt::Kind::grouted;
  scene.bolts[1].bond_stiffness = 1e3 * weight / (length * length);
  scene.bolts[1].bond_strength = 0.1 * weight / length;
}

/// Steps until all are made or one cannot be made.
bool run_steps(Stepper& stepper, int steps) {
  for (int k = 0; k < steps; ++k)
    if (!stepper.step()) return false;
  return true;
}

void expect_resumable(Scene scene, std::mt19937& random) {
  divide_into_stages(scene, random);
  const int cut = static_cast<int>(random() % static_cast<unsigned>(scene.n_steps() + 1));
  const BuiltScene whole = build(scene), resumed = build(scene);
  const bool reached = run_steps(*whole.stepper, cut);
  const std::string record = to_bytes(whole.stepper->run_record());
  resumed.stepper->restore(run_record_from(record));
  ASSERT_TRUE(to_bytes(resumed.stepper->run_record()) == record) << "restored at step " << cut;
  if (!reached) return;
  const int rest = scene.n_steps() - cut;
  EXPECT_EQ(run_steps(*whole.stepper, rest), run_steps(*resumed.stepper, rest));
  EXPECT_TRUE(to_bytes(whole.stepper->run_record()) == to_bytes(resumed.stepper->run_record()))
      << "restored at step " << cut << " of " << scene.n_steps();
  EXPECT_TRUE(whole.stepper->state().position.allFinite() && whole.stepper->state().velocity.allFinite());
  for (const ContactRecord& contact : whole.stepper->contacts())
    EXPECT_TRUE(whole.stepper->blocks().is_present(contact.pair.vertex_block) &&
                whole.stepper->blocks().is_present(contact.pair.edge_block));
}

}  // namespace

TEST(RunRecord, GoesOnToTheBitInRandomStagesOfRandomScenes) {
  std::mt19937 random(1);
  for (std::uint64_t seed = 0; seed < 90; ++seed) {
    if (drop_kind(seed) == DropKind::pile) continue;
    SCOPED_TRACE(name_of(drop_kind(seed)) + ' ' + std::to_string(seed));
    Scene scene = random_drop(seed);
    if (seed % 3 == 1) {
      scene.contact.method = ContactMethod::classic;
      scene.contact.penetration_tolerance = 0;
    }
    if (seed % 5 == 2 && scene.contact.method == ContactMethod::staged) scene.contact.corner_rounding = 0.02;
    if (seed % 4 == 1) {
      scene.analysis.kinematics = Kinematics::incremental;
      scene.analysis.scheme = Scheme::dda;
    }
    const BlockModel models[] = {BlockModel::wachspress, BlockModel::affine, BlockModel::automatic,
                                 BlockModel::mesh};
    for (BlockDescription& block : scene.blocks) {
      block.model = models[seed % (scene.analysis.kinematics == Kinematics::corotational ? 4 : 2)];
      block.mesh.cells = 9;
    }
    if (seed % 5 == 3) bolt_together(scene);
    expect_resumable(scene, random);
  }
}

TEST(RunRecord, GoesOnToTheBitInRandomStagesOfAnyShapes) {
  std::mt19937 random(2);
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    expect_resumable(any_drop(seed), random);
  }
}

TEST(RunRecord, OfContactsThatTheBlocksDoNotHaveIsRefused) {
  const BuiltScene scene = build(random_drop(1000));
  while (scene.stepper->record().contacts.empty()) ASSERT_TRUE(scene.stepper->step());
  for (int VertexEdge::*part :
       {&VertexEdge::vertex_block, &VertexEdge::vertex, &VertexEdge::edge_block, &VertexEdge::edge})
    for (const int wrong : {-1, 1000}) {
      StepRecord record = scene.stepper->record();
      record.contacts[0].pair.*part = wrong;
      EXPECT_THROW(scene.stepper->restore(std::move(record)), Error);
    }
  StepRecord record = scene.stepper->record();
  record.contacts[0].pair.corner = true;
  EXPECT_THROW(scene.stepper->restore(std::move(record)), Error) << "its corners are sharp";
}
