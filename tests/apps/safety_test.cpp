// `dda safety`: the factor of a block on a plane, its files, wrong calls.

#include "program.hpp"

#include <cmath>
#include <numbers>

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
  EXPECT_EQ(found["first_block"], "slider");
  EXPECT_NE(out_.find("\"slider\" moves first"), std::string::npos) << out_;
  const auto rows = read_csv(directory_ / "result/safety.csv");
  EXPECT_EQ(rows.size(), 1 + found["trials"].get<std::size_t>());
  EXPECT_EQ(rows[0][0], "factor");
  EXPECT_EQ(rows[0][3], "kinetic");
  for (std::size_t k = 1; k < rows.size(); ++k)
    EXPECT_EQ(rows[k][1], std::stod(rows[k][0]) < exact ? "rests" : "moves");
  EXPECT_NE(read_file(directory_ / "result/safety.svg").find("</svg>"), std::string::npos);
}

TEST_F(Program, SafetyWarnsOfCohesionThatIsLostBitByBit) {
  const std::string coarsely = "safety " + slope + " -o result --set analysis.preset=default --tolerance 0.5";
  ASSERT_EQ(dda(coarsely), 0) << err_;
  EXPECT_EQ(err_.find("loses its cohesion"), std::string::npos) << err_;
  ASSERT_EQ(dda(coarsely + " --set 'joint.0.cohesion=1 kPa'"), 0) << err_;
  EXPECT_NE(err_.find("joint \"interface\" loses its cohesion"), std::string::npos) << err_;
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
