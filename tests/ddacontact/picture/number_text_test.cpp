// Numbers as texts: prefixes, digits, ticks.

#include <ddacontact/picture/number_text.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace {

using namespace ddacontact;

TEST(NumberText, QuantitiesCarryPrefixAndFewDigits) {
  EXPECT_EQ(quantity_text(3.4213e6, "Pa"), "3.42 MPa");
  EXPECT_EQ(quantity_text(-35000, "N/m"), "\u221235 kN/m");
  EXPECT_EQ(quantity_text(0, "Pa"), "0 Pa");
  EXPECT_EQ(quantity_text(0.00061, "m"), "610 \u00b5m");
  EXPECT_EQ(quantity_text(0.719, "m"), "0.719 m");
  EXPECT_EQ(quantity_text(4.5e7, "m"), "45000 km");
  EXPECT_EQ(quantity_text(4000, "s"), "4000 s");
  EXPECT_EQ(quantity_text(1e15, "Pa"), "1000000 GPa");
  EXPECT_EQ(quantity_text(2.5e18, "Pa"), "2.5\u00d710\u2079 GPa");
  EXPECT_EQ(quantity_text(999.7, "Pa"), "1 kPa");  // as rounded
  EXPECT_EQ(quantity_text(1e-12, "Pa"), "0.001 nPa");
  EXPECT_EQ(number_text(12.5, 2), "12");  // to even, as printed by the standard library
  EXPECT_EQ(number_text(2.9e-5, 2), "2.9\u00d710\u207b\u2075");
}

TEST(NumberText, WhatIsNoNumberIsNeverPrintedAsOne) {
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(number_text(value, 3), "undefined");
    EXPECT_EQ(quantity_text(value, "Pa"), "undefined Pa");
  }
}

TEST(Ticks, AreFewInRangesThatNoNumberDivides) {
  for (const double low : {1., -3e7, 1e300}) {
    const std::size_t n = ticks_between(low, std::nextafter(low, 1e308), 6).values.size();
    EXPECT_GE(n, 1u) << low;
    EXPECT_LE(n, 7u) << low;
  }
  EXPECT_TRUE(ticks_between(-1e308, 1e308, 6).values.empty()) << "its length is no number";
}

TEST(Ticks, AreFewRoundAndWithinTheRange) {
  for (const double size : {1e-12, 1e-3, 1., 1e6, 1e12})
    for (const double low : {-7.3, -1., 0., 2.2, 1000.})
      for (const double length : {0.31, 1., 4.7, 9.99}) {
        const double a = size * low, b = size * (low + length);
        const Ticks ticks = ticks_between(a, b, 6);
        ASSERT_GE(ticks.values.size(), 2u) << a << " " << b;
        EXPECT_LE(ticks.values.size(), 7u);
        const double mantissa = ticks.step / std::pow(10., std::floor(std::log10(ticks.step * 1.0000001)));
        EXPECT_LT(std::min({std::abs(mantissa - 1), std::abs(mantissa - 2), std::abs(mantissa - 2.5),
                            std::abs(mantissa - 5)}),
                  1e-9);
        EXPECT_GE(ticks.values.front(), a - 1e-5 * ticks.step);
        EXPECT_LE(ticks.values.back(), b + 1e-5 * ticks.step);
        EXPECT_LT(ticks.values.front() - a, ticks.step * 1.00001);
        EXPECT_LT(b - ticks.values.back(), ticks.step * 1.00001);
        std::set<std::string> texts;
        for (const double value : ticks.values) texts.insert(tick_text(value, ticks.step));
        EXPECT_EQ(texts.size(), ticks.values.size()) << "two ticks read alike";
      }
}

TEST(Ticks, AreWrittenWithTheDigitsOfTheirStep) {
  EXPECT_EQ(tick_text(-7.5, 2.5), "\u22127.5");
  EXPECT_EQ(tick_text(5, 2.5), "5.0");
  EXPECT_EQ(tick_text(20, 10), "20");
  EXPECT_EQ(tick_text(0.05, 0.025), "0.050");
  EXPECT_EQ(tick_text(1e-17, 0.5), "0");
  EXPECT_EQ(tick_text(2.5e8, 5e7), "2.5\u00d710\u2078");
}

TEST(RoundStep, IsTheSmallestThatIsNotTooFine) {
  EXPECT_DOUBLE_EQ(round_step(10, 10), 1);
  EXPECT_DOUBLE_EQ(round_step(10.1, 10), 2);
  EXPECT_DOUBLE_EQ(round_step(0.21, 10), 0.025);
  EXPECT_DOUBLE_EQ(round_below(0.99), 0.5);
  EXPECT_DOUBLE_EQ(round_below(1000), 1000);
  EXPECT_DOUBLE_EQ(round_below(4.99e6), 2e6);
}

TEST(LogarithmicTicks, AreFewWithinTheRangeAndReadApart) {
  for (const double low : {1e-12, 3e-5, 1., 47.})
    for (const double ratio : {9., 30., 300., 1e7, 1e15}) {
      const std::vector<double> ticks = logarithmic_ticks(low, low * ratio, 6);
      ASSERT_GE(ticks.size(), 2u) << low << " " << ratio;
      EXPECT_LE(ticks.size(), 8u) << low << " " << ratio;
      EXPECT_GE(ticks.front(), low * (1 - 1e-8));
      EXPECT_LE(ticks.back(), low * ratio * (1 + 1e-8));
      std::set<std::string> texts;
      for (const double tick : ticks) texts.insert(decade_text(tick));
      EXPECT_EQ(texts.size(), ticks.size());
    }
  EXPECT_EQ(logarithmic_ticks(1e-3, 1e1, 6), (std::vector<double>{1e-3, 1e-2, 1e-1, 1, 10}));
}

TEST(LogarithmicTicks, ReadAsPowersOfTen) {
  EXPECT_EQ(decade_text(1e-3), "10\u207b\u00b3");
  EXPECT_EQ(decade_text(2e4), "2\u00d710\u2074");
  EXPECT_EQ(decade_text(0.5), "0.5");
  EXPECT_EQ(decade_text(1), "1");
  EXPECT_EQ(decade_text(20), "20");
}

}  // namespace
