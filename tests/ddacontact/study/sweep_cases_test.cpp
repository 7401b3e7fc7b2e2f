#include <ddacontact/study/sweep_cases.hpp>
#include <ddacontact/study/sweep_results.hpp>

#include <ddacontact/core/types.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace {

using namespace ddacontact;
using Values = std::vector<std::string>;

TEST(Variation, ReadsListsRangesAndWholeNumbers) {
  EXPECT_EQ(parse_variation("a.b=1,2.5,x").values, (Values{"1", "2.5", "x"}));
  EXPECT_EQ(parse_variation("a.b=1,2.5,x").path, "a.b");
  EXPECT_EQ(parse_variation("a=0:1:5").values, (Values{"0", "0.25", "0.5", "0.75", "1"}));
  EXPECT_EQ(parse_variation("a=30:20:3").values, (Values{"30", "25", "20"}));
  EXPECT_EQ(parse_variation("seed=3..6").values, (Values{"3", "4", "5", "6"}));
  EXPECT_EQ(parse_variation("seed=1..3,9").values, (Values{"1", "2", "3", "9"}));
  EXPECT_EQ(parse_variation("a=0:1:2,\"1:2\"").values, (Values{"0", "1", "\"1:2\""}));
  EXPECT_EQ(parse_variation("a=7").values, Values{"7"});
  EXPECT_EQ(parse_variation("gravity=[0, -9.8],[1, -9.8]").values, (Values{"[0, -9.8]", "[1, -9.8]"}));
}

TEST(NumberOfACell, MayHaveAUnit) {
  EXPECT_EQ(number_of("2.5"), 2.5);
  EXPECT_EQ(number_of("10 kN"), 10e3);
  EXPECT_EQ(number_of("30e3"), 30e3);
  EXPECT_DOUBLE_EQ(number_of("30 deg").value_or(0), 30);
  for (const char* text : {"", "kN", "10 sheep", "true", "1 2"})
    EXPECT_EQ(number_of(text), std::nullopt) << text;
}

TEST(Variation, BothEndsOfARangeAreExact) {
  const Values values = parse_variation("a=0.1:0.7:7").values;
  EXPECT_EQ(values.front(), "0.1");
  EXPECT_EQ(values.back(), "0.7");
}

TEST(Variation, RefusesWhatVariesNothing) {
  for (const char* text :
       {"", "a", "=1", "a=", "a=1,,2", "a=6..3", "a=0:1:1", "a=0:1:0", "a=1:2", "a=0:1:2.5"})
    EXPECT_THROW(parse_variation(text), Error) << text;
}

/// What the error says, or nothing.
template <class Call>
std::string error_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Variation, SaysWhyARangeIsRefused) {
  for (const auto& [text, why] : {std::pair{"x=3..1", "the range '3..1', which descends"},
                                  {"x=1..100000000", "'1..100000000' of more than 1000000 values"},
                                  {"x=-9000000000000000000..9000000000000000000", "more than 1000000 values"},
                                  {"x=0:1:2000000", "'0:1:2000000' of more than 1000000 values"}}) {
    const std::string error = error_of([&] { parse_variation(text); });
    EXPECT_NE(error.find(why), std::string::npos) << error;
  }
}

TEST(SweepCases, AreAllCombinationsTheLastChangingFastest) {
  const SweepCases cases = sweep_cases({parse_variation("a=1,2"), parse_variation("b=x,y,z")}, {});
  ASSERT_EQ(cases.rows.size(), 6u);
  EXPECT_EQ(cases.settings(0), (Values{"a=1", "b=x"}));
  EXPECT_EQ(cases.settings(1), (Values{"a=1", "b=y"}));
  EXPECT_EQ(cases.settings(5), (Values{"a=2", "b=z"}));
}

TEST(SweepCases, AreRefusedWhenTheyAreNoneManyOrDouble) {
  EXPECT_THROW(sweep_cases({}, {}), Error);
  EXPECT_THROW(sweep_cases({parse_variation("a=1,2"), parse_variation("a=3")}, {}), Error);
  EXPECT_THROW(sweep_cases({parse_variation("a=1..2000"), parse_variation("b=1..2000")}, {}), Error);
}

/// A byte order mark, carriage returns and lines without anything, as spreadsheets write them.
TEST(SweepCases, ReadTheTableOfASpreadsheet) {
  const std::filesystem::path path = testing::TempDir() + "/spreadsheet.csv";
  std::ofstream(path, std::ios::binary)
      << "\xEF\xBB\xBFjoint.0.friction_angle,analysis.steps\r\n30,5\r\n\r\n35,6\r\n\r\n";
  const SweepCases cases = sweep_cases({}, path);
  ASSERT_EQ(cases.rows.size(), 2u);
  EXPECT_EQ(cases.settings(1), (Values{"joint.0.friction_angle=35", "analysis.steps=6"}));
}

TEST(SweepCases, AreRefusedOfATableWithAColumnTwiceOrWithoutRows) {
  const std::filesystem::path path = testing::TempDir() + "/refused.csv";
  for (const auto& [text, why] :
       {std::pair{"a,b,a\n1,2,3\n", "the column 'a' twice"}, {"a,b\n", "no rows below its header"}}) {
    std::ofstream(path, std::ios::binary) << text;
    const std::string error = error_of([&] { sweep_cases({}, path); });
    EXPECT_NE(error.find(why), std::string::npos) << error;
    EXPECT_NE(error.find("refused.csv"), std::string::npos) << error;
  }
}

TEST(SweepCases, NameTheSeparatorOfATableThatHasAnother) {
  const std::filesystem::path path = testing::TempDir() + "/semicolons.csv";
  for (const char* text : {"a;b\n1;2\n", "a\tb\n1\t2\n"}) {
    std::ofstream(path, std::ios::binary) << text;
    try {
      sweep_cases({}, path);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("write commas"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
