// Factors of safety against those of limit equilibrium: plane failure, two blocks on a bent plane, a column
// that topples off its bond.
#include "rock_on_joints.hpp"

namespace {

using namespace support;

/// A block of 3 x 1 m on a plane, one width above its toe.
Scene plane_failure(double slope_degrees, double friction_angle) {
  Scene scene = rock({"plane", friction_angle, 0, 0, std::nullopt});
  add(scene, turned(rectangle(0, -1, 10, 1), radians(slope_degrees)), true);
  add(scene, turned(rectangle(4, 0, 3, 1), radians(slope_degrees)));
  return scene;
}

TEST(StrengthReduction, PlaneFailureHasTheFactorOfItsFormula) {
  for (const auto& [slope, friction] :
       {std::pair{30.0, 40.0}, std::pair{35.0, 20.0}, std::pair{15.0, 45.0}}) {
    const double exact = std::tan(radians(friction)) / std::tan(radians(slope));
    const FactorBracket bracket = factor_of(plane_failure(slope, friction));
    EXPECT_NEAR(bracket.low, exact, 0.01 * exact);
    EXPECT_NEAR(bracket.high, exact, 0.01 * exact);
  }
}

/// Ten steps of balance before a load acts say nothing of it.
TEST(StrengthReduction, WaitsForLoadsThatAreYetToCome) {
  const double friction = 35, weight = 3 * density * gravity, push = weight * std::tan(radians(friction)) / 2;
  Scene scene = rock({"floor", friction, 0, 0, std::nullopt});
  add(scene, rectangle(-5, -1, 15, 1), true);
  add(scene, rectangle(0, 0, 3, 1));
  Load load;
  load.block = 1;
  load.at = {0, 0.2};
  load.force = history_function(TimeFunction::Kind::history, {{0, 0, 0}, {0.5, 0, 0}, {1, push, 0}});
  scene.loads = {load};
  const FactorBracket bracket = factor_of(scene);
  EXPECT_NEAR(bracket.low, 2, 0.02);
  EXPECT_NEAR(bracket.high, 2, 0.02);
}

/// A seismic coefficient as a record, or a load that goes away: blocks rest after it at every factor.
TEST(StrengthReduction, RefusesWhatIsOverBeforeAStaticVerdict) {
  Scene scene = plane_failure(20, 30);
  scene.analysis.mode = ddacontact::Mode::statics;
  scene.loads = {
      point_load(1, {5, 2}, history_function(TimeFunction::Kind::history, {{0, 0, 0}, {1, 1e3, 0}}))};
  EXPECT_NO_THROW(StrengthReduction(scene, {0}));
  scene.loads[0].force.history.emplace_back(2, 0, 0);
  EXPECT_THROW(StrengthReduction(scene, {0}), ddacontact::Error);
  scene.loads.clear();
  scene.quakes = {{history_function(TimeFunction::Kind::history, {{0, -2, 0}, {100, -2, 0}})}};
  EXPECT_THROW(StrengthReduction(scene, {0}), ddacontact::Error);
  scene.analysis.mode = ddacontact::Mode::dynamic;
  EXPECT_NO_THROW(StrengthReduction(scene, {0}));
}

/// With 1e5 1/s its factor would be half as large again.
TEST(StrengthReduction, NotesDampingThatHoldsWhatSlides) {
  for (const double damping : {0., 10., 1e5}) {
    Scene scene = plane_failure(20, 30);
    scene.analysis.damping.mass = damping;
    const StrengthReduction reduction(scene, {0});
    EXPECT_EQ(
        std::ranges::any_of(reduction.notes(),
                            [](const std::string& note) { return note.starts_with("damping by mass"); }),
        damping > 1e3)
        << damping;
  }
}

TEST(StrengthReduction, RefusesScenesInWhichNothingCanMove) {
  Scene scene = plane_failure(20, 30);
  scene.blocks[1].fixed = true;
  EXPECT_THROW(StrengthReduction(scene, {0}), ddacontact::Error);
}

/// A trial goes on as long after the last change as it would without changes, however late that is.
TEST(StrengthReduction, WaitsForALoadThatGrowsLongerThanItsTrialsTake) {
  const double friction = 35, weight = 3 * density * gravity, push = weight * std::tan(radians(friction)) / 3;
  Scene scene = rock({"floor", friction, 0, 0, std::nullopt});
  add(scene, rectangle(-5, -1, 15, 1), true);
  add(scene, rectangle(0, 0, 3, 1));
  scene.loads = {point_load(1, {0, 0.2}, constant({push, 0}))};
  scene.loads[0].force.rise = 12;
  scene.stages = {scene.stage("settled"), scene.stage("pushed")};
  for (StageDescription& stage : scene.stages) stage.analysis.mode = ddacontact::Mode::statics;
  scene.stages[0].analysis.steps = 10;
  scene.stages[1].analysis.steps = 50;
  const StrengthReduction reduction(scene, {0});
  EXPECT_EQ(reduction.try_factor(2.9).verdict, Verdict::rests);
  EXPECT_EQ(reduction.try_factor(3.1).verdict, Verdict::moves);
}

/// Straight vertices of the base at the toe of a block and ahead of it meet its face as it slips, and have no
/// part in the cohesion, which counted up to three times.
TEST(StrengthReduction, StraightVerticesAheadAddNoCohesion) {
  const double slope = 30, length = 4, weight = length * density * gravity, cohesion = 20e3;
  const double exact = std::tan(radians(20)) / std::tan(radians(slope)) +
                       cohesion * length / (weight * std::sin(radians(slope)));
  for (const std::vector<double>& straight :
       {std::vector<double>{4.}, {3.99}, {3.97, 3.98, 3.99}, {4., 8.}}) {
    Scene scene = rock({"plane", 20, cohesion, 0, std::nullopt});
    std::vector<Vec2> top{{14, 0}};
    for (auto x = straight.rbegin(); x != straight.rend(); ++x) top.emplace_back(*x, 0);
    top.emplace_back(0, 0);
    Points base(2, static_cast<Index>(top.size()) + 2);
    base.col(0) = Vec2(0, -1);
    base.col(1) = Vec2(14, -1);
    for (std::size_t k = 0; k < top.size(); ++k) base.col(static_cast<Index>(k) + 2) = top[k];
    add(scene, turned(base, radians(slope)), true);
    add(scene, turned(rectangle(4, 0, length, 1), radians(slope)));
    const FactorBracket bracket = factor_of(scene);
    EXPECT_NEAR(bracket.low, exact, 0.01 * exact) << straight.front() << ' ' << straight.size();
    EXPECT_NEAR(bracket.high, exact, 0.01 * exact);
  }
}

/// A wedge of rock with a level top on a plane of 40 degrees and 14 m, 35 degrees of friction, 20 kPa of
/// cohesion.
struct WedgeOnPlane {
  Joint plane{"plane", 35, 20e3, 0, std::nullopt};
  int cells = 0;  ///< of its mesh; 0: affine

  static constexpr double length = 14;
  static Vec2 top() { return length * Vec2(std::cos(radians(40)), std::sin(radians(40))); }

  Scene scene() const {
    Scene scene = rock(plane);
    add(scene, turned(rectangle(-10, -1, 30, 1), radians(40)), true);
    Points wedge(2, 3);
    wedge << Vec2::Zero(), top(), Vec2(top().y() / std::tan(radians(60)), top().y());
    add(scene, wedge);
    if (cells == 0) return scene;
    scene.blocks.back().model = BlockModel::mesh;
    scene.blocks.back().mesh.cells = cells;
    return scene;
  }

  /// Of limit equilibrium.
  double factor() const {
    const double area = top().y() * (top().x() - top().y() / std::tan(radians(60))) / 2;
    const double weight = density * gravity * area;
    return (plane.cohesion * length +
            weight * std::cos(radians(40)) * std::tan(radians(plane.friction_angle))) /
           (weight * std::sin(radians(40)));
  }
};

TEST(StrengthReduction, CohesionActsAllAtOnce) {
  const WedgeOnPlane wedge;
  const FactorBracket bracket = factor_of(wedge.scene());
  EXPECT_NEAR(bracket.low, wedge.factor(), 0.01 * wedge.factor());
  EXPECT_NEAR(bracket.high, wedge.factor(), 0.01 * wedge.factor());
}

/// Cohesion holds the thin end of the wedge back and pulls it off the plane, line of action below its middle.
/// Without tensile strength the end opens, and an open joint has no cohesion: 2.6 % at 64 cells.
TEST(StrengthReduction, ThinEndOfAMeshedWedgeOpensUnlessItBearsTension) {
  WedgeOnPlane wedge{.cells = 64};
  const double exact = wedge.factor();
  EXPECT_NEAR(factor_of(wedge.scene()).low, 0.974 * exact, 0.01 * exact);
  wedge.plane.tensile_strength = 1e6;
  EXPECT_NEAR(factor_of(wedge.scene()).low, exact, 0.01 * exact);
}

/// A brittle joint breaks from its ends.
TEST(StrengthReduction, JointWithResidualFrictionLosesCohesionWhereItSlips) {
  WedgeOnPlane wedge{.cells = 64};
  wedge.plane.residual_friction_angle = wedge.plane.friction_angle;
  EXPECT_TRUE(is_ductile(WedgeOnPlane{}.plane));
  EXPECT_FALSE(is_ductile(wedge.plane));
  EXPECT_LT(factor_of(wedge.scene(), 0.05).high, 0.75 * wedge.factor());
}

/// The resultant of a block's weight and a horizontal acceleration of tan(20 degrees) g turns a column of
/// 1 x 5 m about its toe; the bond of its other corner, half of the base times its tensile strength, holds
/// it.
TEST(StrengthReduction, ColumnTopplesWhereItsBondBreaks) {
  const double height = 5, tilt = radians(20), tension = 150e3;
  Scene scene = rock({"bond", 60, 500e3, tension, std::nullopt});
  scene.analysis.gravity = gravity * Vec2(std::sin(tilt), -std::cos(tilt));
  add(scene, rectangle(0, -1, 6, 1), true);
  add(scene, rectangle(2, 0, 1, height));
  const double weight = density * gravity * height;
  const double exact = tension / (weight * (height * std::sin(tilt) - std::cos(tilt)));
  const FactorBracket bracket = factor_of(scene);
  EXPECT_NEAR(bracket.low, exact, 0.01 * exact);
  EXPECT_NEAR(bracket.high, exact, 0.01 * exact);
}

Vec2 along(double angle) {
  return {std::cos(angle), std::sin(angle)};
}
Vec2 left_of(double angle) {
  return {-std::sin(angle), std::cos(angle)};
}

/// Two blocks on a plane that bends: the upper one pushes the lower one out. Their common face begins a metre
/// above the bend, so that the upper block may slide on along the steep part.
struct BentPlane {
  double upper = radians(50), lower = radians(5), interface = radians(100), friction = radians(35);
  Points upper_block = Points(2, 3), lower_block = Points(2, 5);

  BentPlane() {
    const Vec2 begin = along(upper), top = begin + 6 * along(interface), toe = -8 * along(lower);
    upper_block << begin, 8 * along(upper), top;
    lower_block << toe, Vec2::Zero(), begin, top, toe + Vec2(0, 3);
  }

  Scene scene() const {
    Scene scene = rock({"joint", friction * 180 / std::numbers::pi, 0, 0, std::nullopt});
    add(scene, turned(rectangle(0, -1, 9, 1), upper), true);
    add(scene, turned(rectangle(-12, -1, 12, 1), lower), true);
    add(scene, upper_block);
    add(scene, lower_block);
    return scene;
  }

  static double weight(const Points& p) {
    double twice = 0;
    for (Index k = 0; k < p.cols(); ++k) {
      const Index next = (k + 1) % p.cols();
      twice += p(0, k) * p(1, next) - p(0, next) * p(1, k);
    }
    return density * gravity * twice / 2;
  }

  /// What holds the lower block back beyond friction when all three faces slide, strength divided by a
  /// factor.
  double needed_to_hold(double factor) const {
    const double mu = std::tan(friction) / factor;
    Eigen::Matrix2d of_upper, of_lower;
    const Vec2 between = -left_of(interface) + mu * along(interface);  // on the upper block
    of_upper << left_of(upper) + mu * along(upper), between;
    const Vec2 forces = of_upper.inverse() * Vec2(0, weight(upper_block));
    of_lower << left_of(lower) + mu * along(lower), along(lower);
    return (of_lower.inverse() * (Vec2(0, weight(lower_block)) + forces.y() * between)).y();
  }

  double factor() const {
    double low = 0.5, high = 5;
    for (int k = 0; k < 60; ++k) {
      const double middle = (low + high) / 2;
      (needed_to_hold(middle) > 0 ? high : low) = middle;
    }
    return low;
  }
};

TEST(StrengthReduction, WedgeOfTwoBlocksHasTheFactorOfLimitEquilibrium) {
  const BentPlane wedge;
  const double exact = wedge.factor();
  ASSERT_GT(exact, 1.1);
  const FactorBracket bracket = factor_of(wedge.scene());
  EXPECT_NEAR(bracket.low, exact, 0.01 * exact);
  EXPECT_NEAR(bracket.high, exact, 0.01 * exact);
}

/// However far a trial would have to go: beyond the slip for half of the stage is enough.
TEST(StrengthReduction, WhatStaysBeyondTheSlipMoves) {
  const TrialLimits limits{.displacement = 1e9};
  const StrengthTrial trial = StrengthReduction(plane_failure(30, 40), {0}).try_factor(1.6, limits);
  EXPECT_EQ(trial.verdict, Verdict::moves);
  EXPECT_NE(trial.reason.find("for 100 steps in a row"), std::string::npos) << trial.reason;
  EXPECT_LT(trial.steps, 300);  // a hundred of them static
}

/// A wedge in a roof, pressed by the blocks beside it, which can move: what glue bore, and friction does not,
/// is let go without a shock. By force P along x on either side: W = 2 P tan(phi - b) for faces b off the
/// vertical.
TEST(StrengthReduction, ShortStepsDoNotShakeBlocksLoose) {
  constexpr double half = 0.8, height = 4, top = 0.1, friction = 60, pressure = 14e3, width = 5;
  Scene scene = rock({"joint", friction, 0, 0, std::nullopt});
  scene.materials[0].young = 30e9;
  Points wedge(2, 4), right(2, 4);
  wedge << -half, half, top, -top, 0, 0, height, height;
  right << half, width, width, top, 0, 0, height, height;
  Points left = right.rowwise().reverse();
  left.row(0) *= -1;
  for (const Points& polygon : {left, right, wedge}) add(scene, polygon);
  for (const int b : {0, 1}) scene.supports.push_back({b, {0, 1, 2, 3}, false, true, {}});
  for (const auto& [b, edge] : {std::pair{0, 1}, std::pair{1, 1}}) {
    Load load;
    load.kind = Load::Kind::pressure;
    load.block = b;
    load.edge = edge;
    load.force = constant({pressure, 0});
    scene.loads.push_back(load);
  }
  const double weight = density * gravity * (half + top) * height, b = std::atan((half - top) / height),
               factor =
                   std::tan(radians(friction)) / std::tan(b + std::atan(weight / (2 * pressure * height)));
  for (const bool glued : {true, false})  // at first: trials let go glue, or the strength that they take away
    for (const double time_step : {0.01, 0.001, 0.0002}) {
      SCOPED_TRACE(testing::Message() << (glued ? "glued, " : "") << time_step);
      scene.analysis.time_step = time_step;
      scene.stages.clear();
      if (!glued) {
        scene.stages = {scene.stage("settle"), scene.stage("last")};
        scene.stages[0].analysis.mode = Mode::statics;
        scene.stages[0].analysis.time_step = 0.01;
        scene.stages[0].analysis.steps = 100;
      }
      const StrengthReduction reduction(scene, {0});
      EXPECT_EQ(reduction.try_factor(0.98 * factor).verdict, Verdict::rests);
      EXPECT_EQ(reduction.try_factor(1.02 * factor).verdict, Verdict::moves);
    }
}

TEST(StrengthReduction, NamesWhatMoves) {
  Scene scene = plane_failure(30, 40);
  add(scene, rectangle(20, 0, 1, 1));
  add(scene, rectangle(20, -1, 1, 1), true);
  const StrengthTrial trial = StrengthReduction(scene, {0}).try_factor(2);
  EXPECT_EQ(trial.verdict, Verdict::moves);
  EXPECT_EQ(trial.first_block, 1);
  EXPECT_EQ(trial.moved_blocks, std::vector<int>{1});
}

TEST(StrengthReduction, ReducesInTheLastStageAlone) {
  Scene scene = plane_failure(30, 40);
  StageDescription settling = scene.stage("settle"), last = scene.stage("last");
  settling.analysis.mode = Mode::statics;
  last.joints[0].friction_angle = 35;
  scene.stages = {settling, last};
  const double exact = std::tan(radians(35)) / std::tan(radians(30));
  const FactorBracket bracket = factor_of(scene);
  EXPECT_NEAR(bracket.low, exact, 0.01 * exact);
}

TEST(StrengthReduction, TrialsDoNotDependOnEachOther) {
  const StrengthReduction reduction(plane_failure(30, 40), {0});
  const StrengthTrial first = reduction.try_factor(1.5);
  reduction.try_factor(3);
  EXPECT_EQ(reduction.try_factor(1.5).max_displacement, first.max_displacement);
}

/// A run that ends before it has moved far is no run at rest.
TEST(StrengthReduction, WhatIsStillMovingAtTheEndMoves) {
  const StrengthReduction reduction(plane_failure(30, 40), {0});
  const TrialLimits few_steps{.displacement = 1e3, .time_factor = 1, .fewest_steps = 20};
  const StrengthTrial trial = reduction.try_factor(2, few_steps);
  EXPECT_EQ(trial.verdict, Verdict::moves);
  EXPECT_LT(trial.max_displacement, 2.0);
}

TEST(StrengthReduction, DividesTheTangentAndNotTheAngle) {
  const Joint joint = reduced({"joint", 45, 30, 20, std::nullopt}, 2);
  EXPECT_NEAR(std::tan(radians(joint.friction_angle)), 0.5, 1e-15);
  EXPECT_EQ(joint.cohesion, 15);
  EXPECT_EQ(joint.tensile_strength, 10);
}

TEST(StrengthReduction, RefusesWhatHasNoStrength) {
  EXPECT_THROW(StrengthReduction(plane_failure(30, 0), {0}), Error);
}

TEST(StrengthReduction, TellsThatItDidNotSettle) {
  Scene scene = plane_failure(30, 20);
  scene.stages = {scene.stage("sliding"), scene.stage("last")};
  EXPECT_NE(StrengthReduction(scene, {0}).unsettled(), "");
}

}  // namespace
