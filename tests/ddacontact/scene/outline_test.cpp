#include "example_scenes.hpp"

#include <ddacontact/scene/outline_check.hpp>

#include <cmath>
#include <numbers>
#include <random>
#include <sstream>

namespace {

using namespace example_scenes;
using namespace ddacontact;
using namespace ddacontact::scene_format;

Outline regular_polygon(int n, double size, const Vec2& centre) {
  Outline outline;
  outline.points.resize(2, n);
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * k / n;
    outline.points.col(k) = centre + size * Vec2(std::cos(angle), std::sin(angle));
    outline.places.push_back({nullptr, 1, k + 1});
  }
  return outline;
}

TEST(Outline, RegularPolygonsOfAnySizeAndOffsetAreSound) {
  for (const int n : {3, 4, 7, 50, 100, 1000})
    for (const double size : {1e-6, 1.0, 1e6})
      for (const double offset : {0.0, 1.0, 1e4}) {
        ProblemList problems("test");
        const Outline outline = regular_polygon(n, size, Vec2(offset * size, -offset * size));
        EXPECT_TRUE(check_outline(outline, {}, "block", problems).sound())
            << n << ' ' << size << ' ' << offset;
        EXPECT_FALSE(problems.has_errors());
      }
}

TEST(Outline, IsCounterClockwiseOnceChecked) {
  Outline outline = regular_polygon(5, 1, Vec2(0, 0));
  const Points points = outline.points;
  outline.points = points.rowwise().reverse();
  ProblemList problems("test");
  const CheckedOutline checked = check_outline(outline, {}, "block", problems);
  EXPECT_EQ(checked.polygon, points);
  EXPECT_TRUE(checked.turned);
  EXPECT_TRUE(std::move(problems).sorted().empty());
}

TEST(Outline, CornersAreNamedAsInTheFileAlsoWhenClockwise) {
  Outline outline = regular_polygon(6, 1, Vec2(0, 0));
  const Points points = outline.points.rowwise().reverse();
  outline.points = points;
  for (int k = 0; k < 6; ++k) {
    outline.points.col(k) = 0.1 * points.col(k);
    ProblemList problems("test");
    EXPECT_FALSE(check_outline(outline, {}, "block", problems).sound());
    const auto found = std::move(problems).sorted();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].what, "block has a concave corner at vertex " + std::to_string(k));
    EXPECT_EQ(found[0].column, k + 1);
    outline.points.col(k) = points.col(k);
  }
}

TEST(Outline, DistanceOutsideIsThatToTheNearestPoint) {
  ProblemList problems("test");
  Outline square = regular_polygon(4, std::sqrt(0.5), Vec2(0, 0));  // a diamond of area 1
  const CheckedOutline checked = check_outline(square, {}, "block", problems);
  EXPECT_DOUBLE_EQ(checked.size, 1);
  EXPECT_EQ(checked.distance_outside(Vec2(0, 0)), 0);
  EXPECT_EQ(checked.distance_outside(square.points.col(0)), 0);
  EXPECT_DOUBLE_EQ(checked.distance_outside(Vec2(2 + std::sqrt(0.5), 0)), 2);
  EXPECT_DOUBLE_EQ(checked.distance_outside(Vec2(1, 1)), std::sqrt(2.0) - 0.5);
}

TEST(Outline, ThinAndTinyBlocksAreAccepted) {
  EXPECT_EQ(scene_of(replaced(minimal, "[1, 1], [0, 1]", "[1, 1e-3], [0, 1e-3]")).blocks.size(), 1u);
  EXPECT_EQ(
      scene_of(replaced(minimal, "[1, 1], [0, 1]", "[1, 1], [0.999999, 1.0000001], [0, 1]")).blocks.size(),
      1u);
}

/// Two unit squares, the second moved by (x, y).
std::string two_squares(double x, double y, const char* first = "", const char* second = "") {
  std::ostringstream text;
  text << replaced(minimal, "[[block]]", "[[block]]\nname = \"first\"\n" + std::string(first))
       << "[[block]]\nmaterial = \"rock\"\n"
       << "vertices = [[" << x << ", " << y << "], [" << x + 1 << ", " << y << "], [" << x + 1 << ", "
       << y + 1 << "], [" << x << ", " << y + 1 << "]]\n"
       << second;
  return text.str();
}

TEST(Overlap, IsAcceptedUpToAThousandthOfTheSize) {
  EXPECT_TRUE(read(two_squares(1, 0)).scene);
  EXPECT_TRUE(read(two_squares(1.5, 0)).scene);
  EXPECT_TRUE(read(two_squares(0.9991, 0.3)).scene);
  EXPECT_FALSE(read(two_squares(0.9989, 0.3)).scene);
  EXPECT_FALSE(read(two_squares(0, 0)).scene);
}

TEST(Overlap, IsMeasuredByTheSizeOfTheSmallerFreeBlock) {
  // A block of size 0.1 that is 5e-4 deep, in one of size 1.
  const std::string small =
      "[[block]]\nmaterial = \"rock\"\nvertices = [[0.9995, 0], [1.0995, 0], [1.0995, 0.1], [0.9995, 0.1]]\n";
  EXPECT_FALSE(read(std::string(minimal) + small).scene);
  EXPECT_TRUE(read(std::string(minimal) + small + "fixed = true\n").scene);
  EXPECT_TRUE(read(std::string(minimal) + small + "fixed = [0, 1, 2, 3]\n").scene);
  EXPECT_TRUE(read(std::string(minimal) + small + "[[support]]\nblock = 1\nvertices = [0, 1, 2, 3]\n").scene);
  EXPECT_FALSE(read(std::string(minimal) + small + "fixed = [0, 1, 2]\n").scene);
}

TEST(Overlap, OfHeldBlocksIsIgnored) {
  EXPECT_TRUE(read(two_squares(0.5, 0.5, "fixed = true\n", "fixed = true\n")).scene);
  EXPECT_FALSE(read(two_squares(0.5, 0.5, "fixed = true\n")).scene);
}

}  // namespace
