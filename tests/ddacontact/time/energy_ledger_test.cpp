#include <ddacontact/block/corotational_block.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <algorithm>

using namespace support;

namespace {

/// A step with `factor` times the elastic forces of its energy.
class MisjudgedStep final : public BlockStep {
 public:
  MisjudgedStep(std::unique_ptr<BlockStep> right, double factor)
      : right_(std::move(right)), factor_(factor) {}

  void free_path(Eigen::Ref<VectorXd> path) const override { right_->free_path(path); }
  void forces(const Eigen::Ref<const VectorXd>& d, BlockForces& forces) const override {
    right_->forces(d, forces);
    forces.elastic() *= factor_;
  }
  void tangent(const Eigen::Ref<const VectorXd>& d, std::span<MatrixXd> parts) const override {
    right_->tangent(d, parts);
  }
  void end(const Eigen::Ref<const VectorXd>& d, const Eigen::Ref<const VectorXd>& external, bool is_free,
           BlockState& next) const override {
    right_->end(d, external, is_free, next);
  }
  double stored_energy(const Eigen::Ref<const VectorXd>& d) const override {
    return right_->stored_energy(d);
  }
  double elastic_loss(const Eigen::Ref<const VectorXd>& d,
                      const Eigen::Ref<const VectorXd>& elastic) const override {
    return right_->elastic_loss(d, elastic);
  }

 private:
  std::unique_ptr<BlockStep> right_;
  double factor_;
};

/// The only block of a system, that makes such steps.
class MisjudgedBlock final : public Block {
 public:
  MisjudgedBlock(const BlockMaterial& material, const PointsRef& outline, double factor)
      : Block(material, outline, static_cast<int>(outline.cols())),
        right_(material, outline,
               std::make_shared<CorotationalShape>(
                   polygon_shape(material, outline, polyfem::wachspress,
                                 choose_integration(outline, GradientCorrection::on)))),
        factor_(factor) {
    right_.number(0, 0, 0, 0, 0);
  }

  std::unique_ptr<Block> copy() const override { return std::make_unique<MisjudgedBlock>(*this); }
  int n_unknowns() const override { return right_.n_unknowns(); }
  int n_stress_points() const override { return right_.n_stress_points(); }
  VectorXd unknown_lengths() const override { return right_.unknown_lengths(); }
  PointMap vertex_map(int vertex) const override { return right_.vertex_map(vertex); }
  const Eigen::Matrix<double, Eigen::Dynamic, 2>& translations() const override {
    return right_.translations();
  }
  void rotation(const BlockState& state, Eigen::Ref<VectorXd> unknowns) const override {
    right_.rotation(state, unknowns);
  }
  void add_body_force(const Vec2& b, VectorXd& F) const override { right_.add_body_force(b, F); }
  void begin_step(const BlockState& state, const StepStart& start,
                  std::unique_ptr<BlockStep>& step) const override {
    std::unique_ptr<BlockStep> right;
    right_.begin_step(state, start, right);
    step = std::make_unique<MisjudgedStep>(std::move(right), factor_);
  }
  MatrixXd times_mass(const Eigen::Ref<const MatrixXd>& v) const override { return right_.times_mass(v); }
  Tensors stress(const BlockState& state) const override { return right_.stress(state); }
  Points integration_points() const override { return right_.integration_points(); }
  const VectorXd& integration_weights() const override { return right_.integration_weights(); }
  Points strain_displacement(const BlockState& state) const override {
    return right_.strain_displacement(state);
  }

 private:
  CorotationalBlock right_;
  double factor_;
};

/// The largest balance error of a turning square that rings from a stress of 1 MPa.
double worst_balance(Scheme scheme, double factor) {
  const BlockMaterial rock{polyfem::elasticity_matrix(1e8, 0.25, Plane::strain), 2000};
  std::vector<std::unique_ptr<Block>> blocks;
  blocks.push_back(std::make_unique<MisjudgedBlock>(rock, rectangle(0, 0, 2, 1), factor));
  BlockSystem system(std::move(blocks));
  BlockState state = system.initial_state();
  state.stress.row(0).setConstant(1e6);
  state.velocity = 3 * system.block(0).rotation(state);

  AnalysisOptions analysis;
  analysis.time_step = 1e-3;
  analysis.kinematics = Kinematics::corotational;
  analysis.scheme = scheme;
  analysis.max_displacement_ratio = 1;
  const ContactProperties contacts{1e9, 4e8, JointTable(JointStrength{}), {0}, ContactMethod::staged, 0};
  Stepper stepper(std::move(system), std::move(state), contacts, analysis);
  double worst = 0;
  for (int k = 0; k < 50; ++k) {
    run(stepper, 1);
    worst = std::max(worst, std::abs(stepper.energy().balance_error()));
  }
  return worst;
}

}  // namespace

TEST(EnergyLedger, OpensWhenAForceIsWrong) {
  EXPECT_LE(worst_balance(Scheme::midpoint, 1), 1e-8);
  EXPECT_GE(worst_balance(Scheme::midpoint, 1.01), 5e-3);
  EXPECT_LE(worst_balance(Scheme::midpoint, 1.01), 0.1);
}

/// The decaying scheme carries blocks on by the motions of their shape.
TEST(EnergyLedger, BlocksWithoutMotionsAreRefusedByTheDecayingScheme) {
  EXPECT_THROW(worst_balance(Scheme::decaying, 1), Error);
}

/// Energy that arises counts against the largest exchange of the whole run, not against that of its first
/// steps.
TEST(EnergyLedger, EnergyFromNowhereIsAPartOfTheLargestExchange) {
  EnergyLedger ledger;
  ledger.now.gravity = 100;
  ledger.start();
  ledger.now.kinetic = 1;
  ledger.close_step(0);
  EXPECT_EQ(ledger.created(), 0) << "it may be gone in the next step";
  ledger.close_step(0);
  EXPECT_NEAR(ledger.created(), 1, 1e-12);
  ledger.now.gravity = 0;
  ledger.now.kinetic = 101;
  ledger.close_step(0);
  EXPECT_NEAR(ledger.created(), 0.01, 1e-3);
}

TEST(EnergyLedger, KnowsTheMostThatIsPushedOutInOneStep) {
  EnergyLedger ledger;
  ledger.start();
  for (const double pushed : {1., 4., 4., 6.}) {
    ledger.now.pushed_out = pushed;
    ledger.close_step(0.5);
  }
  EXPECT_EQ(ledger.pushed_at_once(), 4 - 1 - 0.5);
}

/// A square is thrown along the floor, bounces on a corner, slides and hits another one; damping acts
/// throughout.
TEST(EnergyLedger, OfEverythingAtOnceCloses) {
  for (const Scheme scheme : {Scheme::decaying, Scheme::midpoint}) {
    Scene scene = default_mechanics(rock_scene(0.005, 200), scheme);
    scene.analysis.max_displacement_ratio = 1;
    scene.analysis.damping = {0.2, 1e-4};
    scene.joints[0].friction_angle = 25;
    scene.joints[0].restitution = 0.4;
    scene.joints[0].dashpot = 0.1;
    scene.blocks = {block(rectangle(-2, -1, 14, 1), true),
                    block(turned(rectangle(-0.5, 0.5, 1, 1), 0.1, {0, 1})), block(rectangle(3, 0, 1, 1.5))};
    scene.blocks[1].velocity = {6, 0};
    const BuiltScene built = build(scene);
    for (int k = 0; k < 200; ++k) {
      run(*built.stepper, 1);
      ASSERT_LE(std::abs(built.stepper->energy().balance_error()), 1e-6) << k;
    }
    const Energy& now = built.stepper->energy().now;
    EXPECT_GT(travel(*built.stepper, 2).x(), 0.01);
    EXPECT_GT(now.friction_dissipated, 1e3);
    EXPECT_GT(now.damping_dissipated, 1e3);
  }
}

namespace {

/// Rock of 2 t/m3 and 1 GPa.
Scene rock_at(double time_step, int steps) {
  Scene scene;
  scene.analysis.time_step = time_step;
  scene.analysis.steps = steps;
  scene.analysis.max_displacement_ratio = 10;
  scene.analysis.gravity = Vec2(0, -10);
  scene.materials = {{"rock", 2000, 1e9, 0.2}};
  scene.joints = {{"joint", 20, 0, 0, std::nullopt}};
  scene.contact.normal_stiffness = 4e10;
  scene.contact.tangential_stiffness = 1.6e10;
  return scene;
}

}  // namespace

/// Blocks thrown on a rough floor without weight: corners that meet it slip back by what turns them, and friction
/// gives back what the normal force has taken.
TEST(EnergyLedger, ImpactsWithFrictionMakeNoEnergy) {
  for (const double friction : {10., 20., 45.})
    for (int k = 0; k < 24; ++k) {
      Scene scene = rock_scene(0.01, 4);
      scene.analysis.gravity = Vec2::Zero();
      scene = default_mechanics(scene);
      scene.joints[0].friction_angle = friction;
      Points thrown = turned(rectangle(0, 0, 1, 0.6), radians(7.5 * k + 3));
      thrown.row(1).array() += 0.05 - thrown.row(1).minCoeff();
      scene.blocks = {block(rectangle(-20, -1, 40, 1), true), block(thrown)};
      if (k % 2 == 1)
        scene.blocks.push_back(block(rectangle(-2, -1, 4, 1)));  // thrown on a block on the floor
      if (k % 2 == 1) scene.blocks[0] = block(rectangle(-20, -2, 40, 1), true);
      scene.blocks[1].velocity = Vec2(k % 3 - 1.0, -5);
      const BuiltScene built = build(scene);
      const double before = built.stepper->energy().now.kinetic;
      run(*built.stepper, 4);
      const Energy& now = built.stepper->energy().now;
      EXPECT_LT(built.stepper->energy().created(), 1e-3) << friction << ' ' << k;
      EXPECT_LT(now.kinetic, 0.9 * before) << "it has hit the floor";
      EXPECT_LT(now.pushed_out, 1e-3 * before);
    }
}

/// A dashpot takes no more than a falling block has, however fast it closes within a step.
TEST(EnergyLedger, ADashpotTakesWhatTheFallGave) {
  for (const Scheme scheme :
       {Scheme::decaying, Scheme::central_difference, Scheme::backward_euler, Scheme::midpoint}) {
    SCOPED_TRACE(static_cast<int>(scheme));
    Scene scene = rock_at(0.002, 100);
    scene.analysis.scheme = scheme;
    scene.joints[0].dashpot = 0.5;
    scene.blocks = {block(rectangle(-5, -1, 10, 1), true), block(rectangle(0, 0.05, 1, 1))};
    const BuiltScene built = run(scene);
    const Energy& now = built.stepper->energy().now;
    const double fall = 2000 * 10 * 0.05;
    EXPECT_LE(std::abs(built.stepper->energy().balance_error()), 1e-6);
    EXPECT_LE(now.damping_dissipated, 1.05 * fall);
    EXPECT_GE(now.numerical_dissipated, -0.05 * fall);
  }
}

/// A block of six unknowns hangs at two corners by springs, which a support lifts for a while.
TEST(EnergyLedger, OfVerticesHeldBySpringsCloses) {
  Scene scene = paper_mechanics(rock_at(0.01, 400));
  scene.analysis.preset = Preset::paper;
  scene.contact.normal_stiffness = 1e6;
  scene.blocks = {block(rectangle(0, 0, 1, 1))};
  scene.blocks[0].model = BlockModel::affine;
  const TimeFunction lift{TimeFunction::Kind::history, {0, 0}, {{0, 0, 0}, {0.5, 0, 0.01}}};
  scene.supports = {{0, {2, 3}, true, true, lift}};
  const BuiltScene built = build(scene);
  for (int k = 0; k < 400; ++k) {
    run(*built.stepper, 1);
    ASSERT_LE(std::abs(built.stepper->energy().balance_error()), 1e-4) << k;
  }
  const double weight = 20e3, stored = weight * weight / (4 * scene.contact.normal_stiffness);
  EXPECT_NEAR(built.stepper->energy().now.elastic, stored, 0.01 * stored);
}

TEST(EnergyLedger, BalancesAgainstTheLargestEnergyExchangedSoFar) {
  EnergyLedger ledger;
  ledger.now.kinetic = 100;
  ledger.start();
  ledger.close_step();
  EXPECT_EQ(ledger.balance_error(), 0);  // nothing exchanged
  ledger.now.kinetic = 60;
  ledger.now.gravity = 40;
  ledger.close_step();
  EXPECT_EQ(ledger.balance_error(), 0);
  ledger.now.kinetic = 90;
  ledger.now.gravity = 12;
  ledger.close_step();
  EXPECT_DOUBLE_EQ(ledger.balance_error(), 2. / 40);
  for (double Energy::*dissipated : {&Energy::elastic, &Energy::friction_dissipated,
                                     &Energy::numerical_dissipated, &Energy::damping_dissipated}) {
    EnergyLedger other = ledger;
    other.now.*dissipated = 4;
    EXPECT_DOUBLE_EQ(other.balance_error(), 6. / 40);
  }
  ledger.now.external = 2;
  EXPECT_DOUBLE_EQ(ledger.balance_error(), 0);
}
