// `dda safety`: the factor of a block on a plane, its files, wrong calls.

#include "program.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace {

using namespace support;

const std::string slope = "'" POLYDDA_EXAMPLES "/paper/sliding_30.toml'";

/// The example's block slides at 30 degrees of friction on a plane of 45: it rests where F < tan 30 / tan 45.
TEST_F(Program, SafetyFindsTheFactorOfABlockOnAPlane) {
  ASSERT_EQ(dda("safety " + slope + " -o result --set analysis.preset=default"), 0) << err_;
  const nlohmann::json found = nlohmann::json::parse(read_file(directory_ / "result/safety.json"));
  const double exact = std::tan(30 * std::numbers::pi / 180);
  EXPECT_NEAR(found["factor_low"].get<double>(), exact, 0.01 * exact);
  EXPECT_NEAR(found["factor_high"].get<double>(), exact, 0.01 * exact);
  EXPECT_TRUE(found["settled"].get<bool>());
  EXPECT_EQ(found["rounded_corners"]["verdict"], "rests");
  EXPECT_NEAR(found["rounded_corners"]["factor"].get<double>(), 0.95 * exact, 0.01 * exact);
  EXPECT_EQ(found["poisson_0"]["verdict"], "rests");
  EXPECT_EQ(found["first_block"], "slider");
  EXPECT_NE(out_.find("\"slider\" moves furthest"), std::string::npos) << out_;
  const auto rows = read_csv(directory_ / "result/safety.csv");
  EXPECT_EQ(rows.size(), 1 + found["trials"].get<std::size_t>());
  EXPECT_EQ(rows[0][0], "factor");
  EXPECT_EQ(rows[0][3], "kinetic");
  for (std::size_t k = 1; k < rows.size(); ++k)
    EXPECT_EQ(rows[k][1], std::stod(rows[k][0]) < exact ? "rests" : "moves");
  EXPECT_NE(read_file(directory_ / "result/safety.svg").find("</svg>"), std::string::npos);
}

TEST_F(Program, SafetyPrintsTheDigitsThatItsToleranceNeeds) {
  const auto ends = [&](const std::string& options) {
    EXPECT_EQ(dda("safety " + slope + " -o result --set analysis.preset=default --quiet --force " + options),
              0)
        << err_;
    const std::size_t dots = out_.find(" .. ");
    EXPECT_NE(dots, std::string::npos) << out_;
    const std::string low = out_.substr(0, dots).substr(out_.substr(0, dots).rfind(' ') + 1);
    return std::pair{low, out_.substr(dots + 4, out_.find(';') - dots - 4)};
  };
  EXPECT_LE(ends("--tolerance 0.02").first.size(), std::string("0.1234").size());
  const auto [low, high] = ends("--tolerance 1e-4 --range 0.57:0.585");
  EXPECT_NE(low, high);
  EXPECT_LE(low.size(), std::string("0.123456").size());
}

TEST_F(Program, SafetyIsTheSameForAnyNumberOfTrialsAtOnce) {
  const auto found = [&](const std::string& jobs) {
    EXPECT_EQ(
        dda("safety " + slope + " --set analysis.preset=default --quiet --jobs " + jobs + " -o jobs" + jobs),
        0)
        << err_;
    EXPECT_EQ(err_, "");
    EXPECT_EQ(std::ranges::count(out_, '\n'), 1) << out_;
    return out_ + read_file(directory_ / ("jobs" + jobs + "/safety.csv"));
  };
  const std::string one = found("1");
  EXPECT_EQ(one.find("factor of safety 0.57"), 0u) << one;
  EXPECT_EQ(found("2"), one);
  EXPECT_EQ(found("5"), one);
}

/// The slope that is made slides on its bedding of 25 degrees, whose friction angle is 30.
TEST_F(Program, ThreeCommandsGoFromNothingToAFactorOfSafety) {
  const double exact = std::tan(30 * std::numbers::pi / 180) / std::tan(25 * std::numbers::pi / 180);
  ASSERT_EQ(dda("make joints -o rock.toml"), 0) << err_;
  ASSERT_EQ(dda("plot rock.toml -o rock.svg"), 0) << err_;
  ASSERT_EQ(dda("safety rock.toml -o safety --tolerance 0.03 --range " + std::to_string(0.99 * exact) + ":" +
                std::to_string(1.01 * exact)),
            0)
      << err_;
  EXPECT_NE(err_.find("note: the domain is cut into"), std::string::npos) << err_;
  const nlohmann::json found = nlohmann::json::parse(read_file(directory_ / "safety/safety.json"));
  EXPECT_NEAR(found["factor_low"].get<double>(), 0.99 * exact, 1e-5);
  EXPECT_NEAR(found["factor_high"].get<double>(), 1.01 * exact, 1e-5);
}

/// Blocks settle beside blocks that are fixed, and their corners slide down along flush faces past the
/// corners of the joints in them: none goes in further than the tolerance, 1e-6 of a block.
TEST_F(Program, MadeSlopesOfAnySeedRun) {
  for (const auto& [seed, spacing] : {std::pair(1, 2.6), {1, 2.8}, {3, 2.8}, {6, 3.4}, {7, 2.8}}) {
    ASSERT_EQ(dda("make joints --seed " + std::to_string(seed) + " --spacing " + std::to_string(spacing) +
                  " -o rock.toml"),
              0)
        << err_;
    EXPECT_EQ(dda("run rock.toml --quiet --force --set stage.motion.steps=5"), 0) << err_;
    const nlohmann::json run = nlohmann::json::parse(read_file(directory_ / "rock-out/summary.json"));
    EXPECT_EQ(run["status"], "completed");
    EXPECT_LT(run["max_penetration"].get<double>(), 1.5e-6 * spacing) << seed;
  }
}

/// A bolt across the plane, whose strength the factor leaves as it is.
TEST_F(Program, SafetySaysThatBoltsStayAsStated) {
  ASSERT_EQ(dda("safety " + slope +
                " -o result --set analysis.preset=default --tolerance 0.5 --set 'bolt=[{ name = \"a\", "
                "points = [[3, 11], [1, 5]], area = 1e-3, young = \"200 GPa\", pretension = 1e5 }]'"),
            0)
      << err_;
  EXPECT_NE(out_.find("loads, weights, bolts and water stay as stated"), std::string::npos) << out_;
}

TEST_F(Program, SafetySaysWhatBecomesOfCohesion) {
  const std::string coarsely = "safety " + slope + " -o result --set analysis.preset=default --tolerance 0.5";
  const auto cohesion = [&] {
    return nlohmann::json::parse(read_file(directory_ / "result/safety.json"))["cohesion"].get<std::string>();
  };
  ASSERT_EQ(dda(coarsely), 0) << err_;
  EXPECT_EQ(cohesion(), "none");
  ASSERT_EQ(dda(coarsely + " --set joint.0.residual_friction_angle=20"), 0) << err_;
  EXPECT_NE(err_.find("loses its peak strength"), std::string::npos) << err_;
  ASSERT_EQ(dda(coarsely + " --set 'joint.0.cohesion=1 kPa'"), 0) << err_;
  EXPECT_EQ(cohesion(), "ductile");
  EXPECT_EQ(err_.find("loses its peak strength"), std::string::npos) << err_;
  EXPECT_NE(out_.find("outlast slip"), std::string::npos) << out_;
  ASSERT_EQ(dda(coarsely + " --set 'joint.0.cohesion=1 kPa' --set joint.0.residual_friction_angle=30"), 0)
      << err_;
  EXPECT_EQ(cohesion(), "brittle");
  EXPECT_NE(err_.find("joint \"interface\" has a residual friction angle and loses its peak strength"),
            std::string::npos)
      << err_;
}

const char* const large_and_small = R"(format = 1
[analysis]
steps = 50
time_step = 0.01
block_model = "affine"
[[material]]
name = "rock"
density = 2500
young = "5 GPa"
poisson = 0.25
[[joint]]
name = "plane"
friction_angle = 40
[[block]]
name = "base"
material = "rock"
fixed = true
vertices = [[-20, 0], [0, 0], [10, -8], [10, -9], [-20, -9]]
[[block]]
name = "large"
material = "rock"
vertices = [[-19, 0], [-9, 0], [-9, 9], [-19, 9]]
[[block]]
name = "stone"
material = "rock"
vertices = [[2.5, -2], [5, -4], [5, -2]]
)";

/// A stone slides on the steep part of the base, a block 36 times as large stays on the level part.
TEST_F(Program, SafetySaysHowLittleMoves) {
  write("scene.toml", large_and_small);
  ASSERT_EQ(dda("safety scene.toml -o result --tolerance 0.1"), 0) << err_;
  const nlohmann::json found = nlohmann::json::parse(read_file(directory_ / "result/safety.json"));
  EXPECT_EQ(found["first_block"], "stone");
  EXPECT_EQ(found["moved_count"], 1);
  EXPECT_NEAR(found["moved_area_share"].get<double>(), 2.5 / 92.5, 1e-12);
  EXPECT_NE(out_.find("1 of 2 blocks move, 2.7 % of their area"), std::string::npos) << out_;
  EXPECT_NE(out_.find("note: this is the factor of a small part"), std::string::npos) << out_;
  EXPECT_NE(read_file(directory_ / "result/safety_moved.svg").find("moves furthest"), std::string::npos);
}

TEST_F(Program, SafetyWarnsOfWhatMakesFactorsMeaningless) {
  const std::string coarsely =
      "safety " + slope + " -o result --set analysis.preset=default --range 0.3:0.9 --tolerance 0.5 --quiet ";
  EXPECT_EQ(dda(coarsely), 0) << err_;
  EXPECT_EQ(err_.find("warning"), std::string::npos) << err_;
  EXPECT_EQ(dda(coarsely + "--set analysis.scheme=midpoint"), 0) << err_;
  EXPECT_NE(err_.find("keeps vibrations, under which blocks slip below their limit"), std::string::npos)
      << err_;
  EXPECT_EQ(dda(coarsely + "--set analysis.scheme=midpoint --set analysis.damping.stiffness=1e-3"), 0)
      << err_;
  EXPECT_EQ(err_.find("keeps vibrations"), std::string::npos) << err_;
}

TEST_F(Program, SafetyThatDoesNotSettleLeavesNoOlderFactor) {
  ASSERT_EQ(dda("safety " + slope + " -o result --set analysis.preset=default --tolerance 0.5 --quiet"), 0);
  write("driven.toml",
        "format = 1\n[analysis]\ntime_step = 0.01\n[[material]]\nname = \"rock\"\ndensity = 2500\n"
        "young = 1e10\npoisson = 0.2\n[[joint]]\nfriction_angle = 30\n[[block]]\nmaterial = \"rock\"\n"
        "vertices = [[-1, -1], [2, -1], [2, 0], [-1, 0]]\nfixed = true\n[[block]]\nmaterial = \"rock\"\n"
        "vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]\n[[support]]\nblock = 1\nvertices = [0, 1, 2, 3]\n"
        "history = [[0, 0, 0], [0.05, 0, -0.5]]\n[[stage]]\nsteps = 5\nmode = \"static\"\n[[stage]]\n"
        "steps = 5\n");
  EXPECT_EQ(dda("safety driven.toml -o result --force"), 3);
  const nlohmann::json found = nlohmann::json::parse(read_file(directory_ / "result/safety.json"));
  EXPECT_EQ(found["status"], "stopped");
  EXPECT_TRUE(found["factor_low"].is_null());
  EXPECT_NE(found["reason"].get<std::string>().find("does not settle"), std::string::npos);
}

TEST_F(Program, SafetyRefusesWrongCalls) {
  for (const auto& [arguments, word] :
       {std::pair{"--joints interfase", "did you mean \"interface\"?"}, std::pair{"--range 2:1", "0 < A < B"},
        std::pair{"--range 2", "0 < A < B"}, std::pair{"--tolerance 0", "--tolerance"},
        std::pair{"--set joint.0.friction_angle=0", "friction"}}) {
    EXPECT_EQ(dda("safety " + slope + " -o result --set analysis.preset=default " + arguments), 2)
        << arguments;
    EXPECT_NE(err_.find(word), std::string::npos) << err_;
    EXPECT_FALSE(fs::exists(directory_ / "result")) << arguments;
  }
}

}  // namespace
