// Colours say what they stand for: order by lightness, zero in the middle, bands that cover the data.

#include <ddacontact/picture/colour.hpp>
#include <ddacontact/picture/colour_scale.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace {

using namespace ddacontact;

/// Luminance of an sRGB colour, 0 .. 1: what remains in grey.
double luminance(const Colour& colour) {
  const auto linear = [](int c) {
    const double s = c / 255.;
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(colour.red) + 0.7152 * linear(colour.green) + 0.0722 * linear(colour.blue);
}

TEST(Colours, GreysAreGreyAndTheirLightnessIsRight) {
  EXPECT_EQ(perceptual_colour(0, 0, 0), (Colour{0, 0, 0}));
  EXPECT_EQ(perceptual_colour(1, 0, 0), (Colour{255, 255, 255}));
  const Colour grey = perceptual_colour(0.5, 0, 77);
  EXPECT_EQ(grey.red, grey.green);
  EXPECT_NEAR(luminance(grey), 0.125, 0.002);  // lightness is its cube root
}

TEST(Colours, PrimariesHaveTheirPublishedPlaces) {
  // OKLCh of sRGB red and blue.
  const Colour red = perceptual_colour(0.62796, 0.25768, 29.234),
               blue = perceptual_colour(0.45201, 0.31321, 264.052);
  EXPECT_NEAR(red.red, 255, 2);
  EXPECT_NEAR(red.green, 0, 12);
  EXPECT_NEAR(blue.blue, 255, 2);
  EXPECT_NEAR(blue.red, 0, 12);
}

TEST(Colours, HexIsShortWhereItCanBe) {
  EXPECT_EQ(hex({255, 255, 255}), "#fff");
  EXPECT_EQ(hex({1, 171, 255}), "#01abff");
}

TEST(Colours, LargerMagnitudesAreDarker) {
  for (int k = 0; k < 100; ++k) {
    const double t = k / 100., next = (k + 1) / 100.;
    EXPECT_GT(luminance(sequential_colour(t)), luminance(sequential_colour(next))) << t;
    EXPECT_GT(luminance(diverging_colour(t)), luminance(diverging_colour(next))) << t;
    EXPECT_GT(luminance(diverging_colour(-t)), luminance(diverging_colour(-next))) << t;
  }
}

TEST(Colours, SignsDifferInHueAndZeroHasNone) {
  const Colour zero = diverging_colour(0);
  EXPECT_EQ(zero.red, zero.blue);
  EXPECT_GT(luminance(zero), 0.85);
  for (const double t : {0.2, 0.5, 1.}) {
    EXPECT_GT(diverging_colour(t).red, diverging_colour(t).blue + 20);
    EXPECT_GT(diverging_colour(-t).blue, diverging_colour(-t).red + 20);
  }
}

TEST(ColourScale, BandsCoverTheDataAndZeroIsAloneInTheMiddleOfOne) {
  for (const double low : {-3e6, -0.17, -1e-9, 0., 5., 1e7})
    for (const double length : {1e-9, 2.3, 8e6}) {
      const ValueRange data{low, low + length};
      for (const Field field : {Field::s1, Field::displacement}) {
        if (is_one_value(data, field)) continue;
        const ColourScale scale(field, data);
        EXPECT_LE(scale.bounds().front(), data.low + 1e-5 * length);
        EXPECT_GE(scale.bounds().back(), data.high - 1e-5 * length);
        EXPECT_GE(scale.n_bands(), 24);
        EXPECT_LE(scale.n_bands(), 62);
        EXPECT_FALSE(scale.cut_above() && data.high < scale.bounds().back());
        if (field == Field::s1 && data.low < -0.1 * length && data.high > 0.1 * length) {
          EXPECT_EQ(scale.colour(scale.band(0)), diverging_colour(0));
        }
      }
    }
}

TEST(ColourScale, AConstantIsOneBand) {
  for (const double value : {0., -4e6, 1e-300}) {
    const ColourScale scale(Field::s2, {value, value});
    EXPECT_TRUE(scale.is_constant());
    EXPECT_EQ(scale.n_bands(), 1);
    EXPECT_EQ(scale.band(value), 0);
    EXPECT_FALSE(scale.cut_above() || scale.cut_below());
  }
  EXPECT_EQ(ColourScale(Field::s2, {0, 0}).colour(0), diverging_colour(0));
}

TEST(ColourScale, AnAlmostUniformFieldIsNoExtreme) {
  const ColourScale scale(Field::s2, {-5.0002e6, -5e6});
  EXPECT_TRUE(scale.is_constant());
  EXPECT_GT(luminance(scale.colour(0)), luminance(diverging_colour(-1)) + 0.1);
  const ValueRange shown{-5.0002e6, -5e6};
  EXPECT_FALSE(ColourScale(Field::s2, shown, &shown).is_constant());  // unless the user says so
}

TEST(ColourScale, AGivenRangeIsKeptAndSaysWhatLiesBeyond) {
  const ValueRange shown{-1, 2};
  const ColourScale scale(Field::syy, {-5, 1}, &shown);
  EXPECT_EQ(scale.bounds().front(), -1);
  EXPECT_EQ(scale.bounds().back(), 2);
  EXPECT_TRUE(scale.cut_below());
  EXPECT_FALSE(scale.cut_above());
  EXPECT_EQ(scale.band(-5), 0);
  EXPECT_EQ(scale.band(99), scale.n_bands() - 1);
}

TEST(Fields, AreFoundByTheNamesOfTheResultFiles) {
  for (const char* name :
       {"sxx", "syy", "sxy", "s1", "s2", "displacement", "velocity", "material", "block", "none"})
    EXPECT_TRUE(field_named(name)) << name;
  EXPECT_FALSE(field_named("S1"));
  for (const FieldDescription& field : all_fields()) {
    EXPECT_EQ(field_named(field.name), field.field);
    EXPECT_STREQ(description(field.field).name, field.name);
  }
}

}  // namespace
