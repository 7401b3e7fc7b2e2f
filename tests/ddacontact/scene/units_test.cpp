#include <ddacontact/scene/units.hpp>

#include <gtest/gtest.h>

#include <numbers>

namespace {

using ddacontact::scene_format::parse_unit;
using ddacontact::scene_format::read_quantity;

struct Good {
  const char* text;
  const char* unit;
  double value;
};

class Quantity : public testing::TestWithParam<Good> {};

TEST_P(Quantity, IsConvertedWithoutRoundOff) {
  const Good& c = GetParam();
  const auto reading = read_quantity(c.text, c.unit, "");
  EXPECT_EQ(reading.error, "");
  EXPECT_EQ(reading.value, c.value);
}

INSTANTIATE_TEST_SUITE_P(
    All, Quantity,
    testing::Values(Good{"35 MPa", "Pa", 35e6}, Good{"35MPa", "Pa", 35e6}, Good{"  35   MPa ", "Pa", 35e6},
                    Good{"3.5e1 MPa", "Pa", 35e6}, Good{"-1 kPa", "Pa", -1000}, Good{"+1 kPa", "Pa", 1000},
                    Good{"2 GPa", "Pa", 2e9}, Good{"3 N/m2", "Pa", 3}, Good{"3 N/m^2", "Pa", 3},
                    Good{"3 N m-2", "Pa", 3}, Good{"3 N*m^-2", "Pa", 3}, Good{"3 N.m-2", "Pa", 3},
                    Good{"3 N/m/m", "Pa", 3}, Good{"3 J/m3", "Pa", 3}, Good{"3 kg/m/s2", "Pa", 3},
                    Good{"1 N/mm2", "Pa", 1e6}, Good{"21 kN/m3", "N/m3", 21e3},
                    Good{"2.5 g/cm3", "kg/m3", 2500}, Good{"2.5 t/m3", "kg/m3", 2500},
                    Good{"2500 kg/m3", "kg/m3", 2500}, Good{"5 cm", "m", 0.05}, Good{"57 cm", "m", 0.57},
                    Good{"7 mm", "m", 0.007}, Good{"4 m", "m", 4}, Good{"4 km", "m", 4000},
                    Good{"20 ms", "s", 0.02}, Good{"9.8 m/s2", "m/s2", 9.8}, Good{"980 cm/s2", "m/s2", 9.8},
                    Good{"980 Gal", "m/s2", 9.8}, Good{"980 gal", "m/s2", 9.8}, Good{"36 km/s", "m/s", 36000},
                    Good{"30 deg", "deg", 30}, Good{"30\u00b0", "deg", 30}, Good{"2 rad/s", "rad/s", 2},
                    Good{"2 mrad/s", "rad/s", 0.002}, Good{"3 1/s", "Hz", 3}, Good{"3 kHz", "1/s", 3000},
                    Good{"1 MN/m", "N/m", 1e6}, Good{"0 Pa", "Pa", 0}));

TEST(Units, AnglesConvert) {
  EXPECT_DOUBLE_EQ(read_quantity("0.5 rad", "deg", "").value, 90 / std::numbers::pi);
  EXPECT_DOUBLE_EQ(read_quantity("180 deg/s", "rad/s", "").value, std::numbers::pi);
}

TEST(Units, AForceMayStandForAForcePerMetre) {
  EXPECT_EQ(read_quantity("3 kN", "N/m", "N").value, 3000);
  EXPECT_EQ(read_quantity("3 kN/m", "N/m", "N").value, 3000);
  EXPECT_NE(read_quantity("3 kN/m3", "N/m", "N").error, "");
  EXPECT_NE(read_quantity("3 kN", "N/m", "").error, "");
}

TEST(Units, WhatIsNoQuantityIsRefused) {
  for (const char* text :
       {"",         " ",      "m",
        "5",        "5 x",    "5 xm",
        "5 m/",     "5 /m",   "5 m//s",
        "5 m^",     "5 m-",   "5 m3x",
        "5 kkm",    "5 kdeg", "5 m m m m m m m m m m m m m m m m m m m m m m m m m m m m m m m m m m m m m m",
        "nan m",    "inf m",  "1e400 m",
        "1e-400 m", "--5 m",  "+-5 m",
        "0x5 m",    "5 s",    "5 m2",
        "5 \xff",   "1,5 m",  "5 1/m",
        "5 M"})
    EXPECT_NE(read_quantity(text, "m", "").error, "") << text;
}

TEST(Units, EveryUnitOfTheFormatIsOne) {
  for (const char* unit :
       {"s", "m/s2", "N/m2", "N/m", "kg/m3", "N/m3", "Pa", "deg", "m", "m/s", "rad/s", "N"})
    EXPECT_TRUE(parse_unit(unit)) << unit;
}

}  // namespace
