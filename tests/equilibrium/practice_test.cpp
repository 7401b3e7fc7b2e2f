/// \file Scenes of dams, drums, rockfall and contact, each against what is known of it.
#include <tests/support/run_scene.hpp>

#include <ddacontact/output/run_verdict.hpp>
#include <ddacontact/study/factor_bracket.hpp>
#include <ddacontact/study/strength_reduction.hpp>
#include <ddacontact/time/monitor_target.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace {

using namespace ddacontact;

Vec2 travel_of(const BuiltScene& built, const std::string& monitor) {
  for (const MonitorTarget& target : built.monitor_targets)
    if (target.name == monitor) return observe(target, *built.stepper).displacement;
  throw std::runtime_error("no monitor " + monitor);
}

/// A block on a fixed base of 40 x 1 m, with more text.
SceneReading block_on_base(const std::string& young, const std::string& vertices, const std::string& more) {
  return read_scene_text(
      "[analysis]\nsteps = 200\ntime_step = 0.01\n"
      "[[material]]\nname = \"rock\"\ndensity = 2500\nyoung = " +
          young +
          "\npoisson = 0.2\n[[joint]]\nname = \"all\"\nfriction_angle = 30\n"
          "[[block]]\nname = \"base\"\nmaterial = \"rock\"\nfixed = true\n"
          "vertices = [[-20, -1], [20, -1], [20, 0], [-20, 0]]\n"
          "[[block]]\nname = \"block\"\nmaterial = \"rock\"\nvertices = " +
          vertices + "\n" + more,
      "base.toml");
}

}  // namespace

/// A modulus in the wrong unit: the reader warns, and no block passes through its base without a word.
TEST(Practice, ABlockTooSoftForItsWeightIsNotedOrStops) {
  for (const char* young : {"20", "2e3", "2e4", "1e5"}) {
    const SceneReading reading = block_on_base(young, "[[0, 0], [2, 0], [2, 1], [0, 1]]", "");
    ASSERT_TRUE(reading.scene);
    ASSERT_EQ(reading.problems.size(), 1u) << young;
    EXPECT_NE(reading.problems[0].text().find("strained by its weight"), std::string::npos);
    const BuiltScene built = build(*reading.scene);
    Stepper& stepper = *built.stepper;
    if (!support::run(stepper, 200)) continue;
    const std::vector<std::string> warnings = warnings_of(stepper);
    EXPECT_TRUE(std::ranges::any_of(warnings, [](const std::string& text) {
      return text.starts_with("strains are large");
    })) << young;
    const Points x = stepper.blocks().positions(stepper.state());
    const Range& v = stepper.blocks().block(1).vertices();
    EXPECT_GT(x.row(1).middleCols(v.first, v.count).minCoeff() - x.row(1).minCoeff(), 0.9) << young;
  }
  EXPECT_TRUE(block_on_base("20e9", "[[0, 0], [2, 0], [2, 1], [0, 1]]", "").problems.empty());
}

/// Water 3 m deep behind a block of 4 x 3 m, with uplift from 3 m of head to none: by limit equilibrium
/// F = (W - U) tan(30) / H. A block that slides out of a part of the uplift and rests there has failed.
TEST(Practice, ABlockThatSlidesOutOfItsUpliftHasFailed) {
  const SceneReading reading = block_on_base("20e9", "[[0, 0], [4, 0], [4, 3], [0, 3]]",
                                             "[water]\ntable = [[-30, 3], [1, 3], [1.5, 0], [30, 0]]\n"
                                             "joint_table = [[0, 3], [4, 0]]\n");
  ASSERT_TRUE(reading.scene);
  const StrengthReduction reduction(*reading.scene, {0});
  const FactorBracket bracket =
      bracket_factor([&](double f) { return reduction.try_factor(f).verdict; }, std::nullopt, 0.005);
  constexpr double weight = 12 * 2500 * 9.8, uplift = 1000 * 9.8 * 6, push = 1000 * 9.8 * 4.5;
  const double exact = (weight - uplift) * std::tan(std::numbers::pi / 6) / push;
  EXPECT_LE(bracket.low, 1.005 * exact);
  EXPECT_GE(bracket.high, 0.995 * exact);
}

/// 4 x 1 m of rock on a plane of 30 degrees with as much friction, pressed on it by a bolt that yields at its
/// pretension P: F = (W cos a + P) tan(phi) / (W sin a).
TEST(Practice, ABoltedBlockHasTheFactorOfItsPretension) {
  constexpr double angle = std::numbers::pi / 6, weight = 4 * 2500 * 9.81, pull = 50e3;
  const auto at = [&](double along, double above) {
    std::ostringstream text;
    text << '[' << along * std::cos(angle) - above * std::sin(angle) << ", "
         << along * std::sin(angle) + above * std::cos(angle) << ']';
    return text.str();
  };
  const auto box = [&](double x, double y, double width, double height) {
    return "[" + at(x, y) + ", " + at(x + width, y) + ", " + at(x + width, y + height) + ", " +
           at(x, y + height) + "]\n";
  };
  const SceneReading reading = read_scene_text(
      "[analysis]\nsteps = 100\ntime_step = 0.01\ngravity = [0, -9.81]\n"
      "[[material]]\nname = \"rock\"\ndensity = 2500\nyoung = \"20 GPa\"\npoisson = 0.2\n"
      "[[joint]]\nfriction_angle = 30\n"
      "[[block]]\nmaterial = \"rock\"\nfixed = true\nvertices = " +
          box(-5, -6, 15, 6) + "[[block]]\nmaterial = \"rock\"\nvertices = " + box(0, 0, 4, 1) +
          "[[bolt]]\nname = \"anchor\"\npoints = [" + at(2, -5) + ", " + at(2, 0.5) +
          "]\narea = \"5 cm2\"\nyoung = \"200 GPa\"\npretension = \"50 kN\"\nyield_force = \"50 kN\"\n",
      "bolted.toml");
  ASSERT_TRUE(reading.scene) << reading.problems.front().text();
  const StrengthReduction reduction(*reading.scene, {0});
  const FactorBracket bracket =
      bracket_factor([&](double f) { return reduction.try_factor(f).verdict; }, std::nullopt, 0.004);
  const double exact =
      (weight * std::cos(angle) + pull) * std::tan(std::numbers::pi / 6) / (weight * std::sin(angle));
  EXPECT_NEAR(exact, 1.589, 1e-3);
  EXPECT_NEAR(bracket.low, exact, 0.01 * exact);
  EXPECT_NEAR(bracket.high, exact, 0.01 * exact);
}

/// The factor of limit equilibrium in the scene's first lines.
void expect_factor(const std::string& example, double exact) {
  const SceneReading reading = read_scene(POLYDDA_EXAMPLES "/" + example, {});
  ASSERT_TRUE(reading.scene);
  const StrengthReduction reduction(*reading.scene, {0});
  EXPECT_EQ(reduction.unsettled(), "");
  const FactorBracket bracket =
      bracket_factor([&](double f) { return reduction.try_factor(f).verdict; }, std::nullopt, 0.004);
  EXPECT_NEAR(bracket.low, exact, 0.005 * exact);
  EXPECT_NEAR(bracket.high, exact, 0.005 * exact);
}

TEST(Practice, DamSlidesAtItsFactorOfSafety) {
  expect_factor("dam.toml", (4233.6 + 11.76 - 1470) / (1587.6 - 19.6));
}

TEST(Practice, RetainingWallSlidesAtCoulombsFactor) {
  expect_factor("retaining_wall.toml",
                std::tan(35 * std::numbers::pi / 180) / std::tan(21.0277 * std::numbers::pi / 180));
}

/// The supports bear the weight of all blocks and the load wherever it is; the crown is lowest when it is
/// there.
TEST(Practice, BridgeBearsALoadThatMovesAcross) {
  BuiltScene built = support::build_example("arch_bridge.toml");
  Stepper& stepper = *built.stepper;
  const BlockSystem& blocks = stepper.blocks();
  double weight = 0;
  for (int b = 0; b < blocks.n_blocks(); ++b) weight += 9.8 * blocks.block(b).mass_total();
  double lowest = 0, lowest_at = 0;
  for (int second = 1; second <= 12; ++second) {
    ASSERT_TRUE(support::run(stepper, 20)) << stepper.stop_reason();
    const double load = second == 12 ? 0 : 60e3;
    const double moving = stepper.equilibrium().unbalanced;  // static steps find the way to balance
    EXPECT_LT(moving, 1e-3) << second;
    EXPECT_NEAR(stepper.reactions().row(1).sum(), weight + load, (1e-6 + moving) * weight) << second;
    const double sunk = -travel_of(built, "crown").y();
    if (sunk > lowest) lowest_at = second;
    lowest = std::max(lowest, sunk);
  }
  EXPECT_LT(lowest, 1e-3);
  EXPECT_NEAR(lowest_at, 6, 1);
  EXPECT_TRUE(stepper.is_at_rest());
}

/// What enters a column slowed by its joints, when it reaches the surface and how fast that moves: the first
/// lines of the scene.
TEST(Practice, WaveInAJointedColumnDoublesAtTheSurface) {
  BuiltScene built = support::build_example("jointed_column.toml");
  const double rock = std::sqrt(4e9 / 2500), jointed = rock / std::numbers::sqrt2;
  double fastest = 0, when = 0;
  for (int step = 0; step < 400; ++step) {
    ASSERT_TRUE(built.stepper->step()) << built.stepper->stop_reason();
    const double v = observe(built.monitor_targets[0], *built.stepper).velocity.y();
    if (v > fastest) when = built.stepper->state().time;
    fastest = std::max(fastest, v);
  }
  EXPECT_NEAR(fastest, 0.03 * 2 * 2 / (1 + jointed / rock), 0.01 * 0.07);
  EXPECT_NEAR(when, 0.03 + 60 / jointed, 0.01 * 0.097);
}

/// Half and a quarter of the step agree on how far the top drum sways; the column stands in the end.
TEST(Practice, DrumsSwayTheSameInShorterSteps) {
  std::vector<double> sways;
  for (const int factor : {2, 4}) {
    BuiltScene built =
        support::build_example("drums.toml", {"analysis.time_step=" + std::to_string(0.0025 / factor),
                                              "stage.settle.steps=" + std::to_string(10 * factor),
                                              "stage.shake.steps=" + std::to_string(3200 * factor)});
    double& sway = sways.emplace_back(0);
    for (int step = 0; step < 3210 * factor; ++step) {
      ASSERT_TRUE(built.stepper->step()) << built.stepper->stop_reason();
      sway = std::max(sway, std::abs(travel_of(built, "top").x()));
    }
    EXPECT_LT(travel_of(built, "top").norm(), 0.01);
  }
  EXPECT_GT(sways[1], 0.1);
  EXPECT_NEAR(sways[0], sways[1], 0.01 * sways[1]);
}

/// Boulders come to rest below where they began, and fall no further than the foot.
TEST(Practice, RocksComeToRestOnTheBenches) {
  BuiltScene built = support::build_example("rockfall.toml");
  ASSERT_TRUE(support::run(*built.stepper, 2000)) << built.stepper->stop_reason();
  EXPECT_TRUE(built.stepper->is_at_rest());
  for (const char* name : {"boulder", "slab", "cobble"}) {
    const Vec2 travel = travel_of(built, name);
    EXPECT_GT(travel.x(), 2) << name;
    EXPECT_LT(travel.y(), -5) << name;
    EXPECT_GT(travel.y(), -23) << name;
  }
}

/// A disk of radius 1 m on a rigid plate under its weight, its cells graded towards the contact: half width
/// and largest pressure by Hertz, a = sqrt(4 P R (1 - nu^2) / (pi E)), p = 2 P / (pi a).
TEST(Practice, DiskOnAPlateHasHertzsPressure) {
  constexpr double young = 18.7e6, poisson = 0.3;
  std::vector<double> degrees;
  for (int k = -16; k <= 16; ++k) degrees.push_back(0.5 * k);
  for (int k = 13; k < 352; k += 5) degrees.push_back(k);
  std::ostringstream disk;
  std::size_t top = 0;
  for (std::size_t k = 0; k < degrees.size(); ++k) {
    const double angle = degrees[k] * std::numbers::pi / 180;
    disk << (k > 0 ? ", [" : "[") << std::sin(angle) << ", " << 1 - std::cos(angle) << "]";
    if (std::abs(degrees[k] - 180) < std::abs(degrees[top] - 180)) top = k;
  }
  std::ostringstream scene;
  scene << "[analysis]\nsteps = 40\ntime_step = 0.05\nmode = \"static\"\n"
           "mesh = { kind = \"voronoi\", cells = 64, at_contact = \"8 mm\" }\n"
           "[[material]]\nname = \"soft\"\ndensity = 2500\nyoung = 18.7e6\npoisson = 0.3\n"
           "[[block]]\nname = \"plate\"\nmaterial = \"soft\"\nmodel = \"affine\"\nfixed = true\n"
           "vertices = [[-2, -1], [2, -1], [2, 0], [-2, 0]]\n"
           "[[block]]\nname = \"disk\"\nmaterial = \"soft\"\nmodel = \"mesh\"\nvertices = ["
        << disk.str() << "]\n[[support]]\nblock = \"disk\"\nvertices = [" << top << "]\naxes = \"x\"\n";
  const SceneReading reading = read_scene_text(scene.str(), "disk.toml");
  for (const Problem& problem : reading.problems) ADD_FAILURE() << problem.text();
  ASSERT_TRUE(reading.scene);
  const BuiltScene built = build(*reading.scene);
  ASSERT_TRUE(support::run(*built.stepper, 40)) << built.stepper->stop_reason();
  EXPECT_LE(built.stepper->blocks().block(1).n_cells(), 1000);

  // Places and forces of the nodes in contact; each bears the pressure over half the way to its neighbours.
  const Block& of_disk = built.stepper->blocks().block(1);
  const Points x = built.stepper->blocks().positions(built.stepper->state());
  const auto point = [&](int k) -> Vec2 {
    return x.col(of_disk.vertices().first + (k + of_disk.n_vertices()) % of_disk.n_vertices());
  };
  double force = 0, first = 0, second = 0, most = 0;
  for (const ContactRecord& contact : built.stepper->contacts()) {
    ASSERT_EQ(contact.pair.vertex_block, 1);
    const int k = contact.pair.vertex;
    force += contact.normal;
    first += contact.normal * point(k).x();
    second += contact.normal * point(k).x() * point(k).x();
    most = std::max(most, 2 * contact.normal / std::abs(point(k + 1).x() - point(k - 1).x()));
  }
  const double half_width = std::sqrt(4 * force * (1 - poisson * poisson) / (std::numbers::pi * young));
  // The second moment of Hertz's pressure is a^2 / 4.
  EXPECT_NEAR(2 * std::sqrt(second / force - std::pow(first / force, 2)), half_width, 0.05 * half_width);
  EXPECT_NEAR(most, 2 * force / (std::numbers::pi * half_width), 0.05 * most);
}
