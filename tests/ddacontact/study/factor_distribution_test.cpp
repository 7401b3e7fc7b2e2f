// Mean, spread and probability of failure of many factors of safety.
#include <ddacontact/core/types.hpp>
#include <ddacontact/study/factor_distribution.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace ddacontact;

TEST(FactorDistribution, TakesTheMiddlesOfBrackets) {
  const FactorDistribution found = distribution_of({"1.3", "0.8", "1.0"}, {"1.5", "0.8", "1.2"});
  ASSERT_EQ(found.factors.size(), 3u);
  EXPECT_DOUBLE_EQ(found.factors[0], 0.8);
  EXPECT_DOUBLE_EQ(found.mean(), (1.4 + 0.8 + 1.1) / 3);
  EXPECT_DOUBLE_EQ(found.standard_deviation(), 0.3);
  EXPECT_EQ(found.n_failing(), 1);
  EXPECT_DOUBLE_EQ(found.probability_of_failure(), 1.0 / 3);
  EXPECT_DOUBLE_EQ(found.standard_error(), std::sqrt(2.0 / 27));
}

TEST(FactorDistribution, CountsCasesThatAlwaysOrNeverMove) {
  const FactorDistribution found = distribution_of({"", "1.2", "", "2"}, {"0.1", "", "", "2"});
  EXPECT_EQ(found.n_always, 1);
  EXPECT_EQ(found.n_never, 1);
  EXPECT_EQ(found.n_cases(), 3);
  EXPECT_EQ(found.n_failing(), 1);
  EXPECT_EQ(found.n_unknown, 1);
  EXPECT_NE(describe(found).find("without a factor, and counted nowhere: 1 of the cases"), std::string::npos)
      << describe(found);
}

/// What rests up to 0.9, or moves from 1.2 on, may fail or not.
TEST(FactorDistribution, SaysNothingOfOneWhereAllFactorsWereOnOneSideOfIt) {
  const FactorDistribution found = distribution_of({"0.63", "0.9", "", "1"}, {"0.63", "", "1.2", ""});
  EXPECT_EQ(found.n_move_above, 1);
  EXPECT_EQ(found.n_rest_below, 1);
  EXPECT_EQ(found.n_failing(), 1);
  EXPECT_EQ(found.n_cases(), 4);
  EXPECT_NE(describe(found).find("1 to 3 of 4 cases"), std::string::npos) << describe(found);
}

TEST(FactorDistribution, HasTheMeanOfTheTwoMiddleOnesAsMedian) {
  EXPECT_DOUBLE_EQ(distribution_of({"1.4", "0.6"}, {"1.4", "0.6"}).median(), 1);
  EXPECT_DOUBLE_EQ(distribution_of({"1.4", "0.6", "0.7"}, {"1.4", "0.6", "0.7"}).median(), 0.7);
}

TEST(FactorDistribution, IsDescribedAndDrawn) {
  const FactorDistribution found = distribution_of({"0.9", "1.2", "1.2"}, {"0.9", "1.2", "1.2"});
  const std::string text = describe(found);
  EXPECT_NE(text.find("median 1.2, mean 1.1, standard deviation 0.17, from 0.9 to 1.2"), std::string::npos)
      << text;
  EXPECT_NE(text.find("1 of 3 cases, 0.333 +- 0.27"), std::string::npos) << text;
  EXPECT_NE(text.find("   2 ####"), std::string::npos) << text;
  EXPECT_NE(draw(found).find("</svg>"), std::string::npos);
}

TEST(FactorDistribution, SaysThatThereIsNone) {
  EXPECT_NE(describe({}).find("no case has a factor"), std::string::npos);
  EXPECT_THROW(draw(FactorDistribution{}), Error);
}

}  // namespace
