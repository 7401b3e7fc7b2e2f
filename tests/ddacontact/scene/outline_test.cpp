#include "example_scenes.hpp"

#include <ddacontact/scene/outline_check.hpp>
#include <ddacontact/scene/outline_distance.hpp>
#include <tests/support/concave_polygons.hpp>

#include <Eigen/Geometry>

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
    outline.locations.push_back({nullptr, 1, k + 1});
  }
  return outline;
}

TEST(Outline, RegularPolygonsOfAnySizeAndOffsetAreSound) {
  for (const int n : {3, 4, 7, 50, 100, 1000})
    for (const double size : {1e-6, 1.0, 1e6})
      for (const double offset : {0.0, 1.0, 1e4}) {
        ProblemList problems("test");
        const Outline outline = regular_polygon(n, size, Vec2(offset * size, -offset * size));
        EXPECT_TRUE(check_outline(outline, BlockModel::wachspress, {}, "block", problems).valid())
            << n << ' ' << size << ' ' << offset;
        EXPECT_FALSE(problems.has_errors());
      }
}

TEST(Outline, IsCounterClockwiseOnceChecked) {
  Outline outline = regular_polygon(5, 1, Vec2(0, 0));
  const Points points = outline.points;
  outline.points = points.rowwise().reverse();
  ProblemList problems("test");
  const CheckedOutline checked = check_outline(outline, BlockModel::wachspress, {}, "block", problems);
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
    EXPECT_FALSE(check_outline(outline, BlockModel::wachspress, {}, "block", problems).valid());
    const auto found = std::move(problems).sorted();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].what, "block has a concave corner at vertex " + std::to_string(k) +
                                 ", which the model \"wachspress\" cannot have");
    EXPECT_EQ(found[0].column, k + 1);
    outline.points.col(k) = points.col(k);
  }
}

TEST(Outline, DistanceOutsideIsThatToTheNearestPoint) {
  ProblemList problems("test");
  Outline square = regular_polygon(4, std::sqrt(0.5), Vec2(0, 0));  // a diamond of area 1
  const CheckedOutline checked = check_outline(square, BlockModel::automatic, {}, "block", problems);
  EXPECT_DOUBLE_EQ(checked.size, 1);
  EXPECT_EQ(checked.distance_outside(Vec2(0, 0)), 0);
  EXPECT_EQ(checked.distance_outside(square.points.col(0)), 0);
  EXPECT_DOUBLE_EQ(checked.distance_outside(Vec2(2 + std::sqrt(0.5), 0)), 2);
  EXPECT_DOUBLE_EQ(checked.distance_outside(Vec2(1, 1)), std::sqrt(2.0) - 0.5);
}

constexpr BlockModel all_shapes[] = {BlockModel::automatic, BlockModel::mean_value, BlockModel::affine,
                                     BlockModel::mesh};

Outline outline_of(const Points& points) {
  Outline outline;
  outline.points = points;
  for (int k = 0; k < points.cols(); ++k) outline.locations.push_back({nullptr, 1, k + 1});
  return outline;
}

/// What is wrong with it; empty: nothing.
std::string complaint(const Points& points, BlockModel model) {
  ProblemList problems("test");
  const bool valid = check_outline(outline_of(points), model, {}, "block", problems).valid();
  const auto found = std::move(problems).sorted();
  EXPECT_EQ(valid, found.empty());
  return found.empty() ? std::string() : found[0].what;
}

TEST(Outline, AnySimplePolygonIsSoundForEveryModelButWachspress) {
  for (const auto& [name, polygon] : support::concave_polygons())
    for (const double size : {1e-6, 1.0, 1e6})
      for (const double angle : {0.0, 0.7}) {
        const Points placed = (Eigen::Rotation2Dd(angle).toRotationMatrix() * size * polygon).colwise() +
                              Vec2(3 * size, -1e4 * size);
        for (const Points& points : {placed, Points(placed.rowwise().reverse())}) {
          for (const BlockModel model : all_shapes) EXPECT_EQ(complaint(points, model), "") << name;
          EXPECT_NE(complaint(points, BlockModel::wachspress), "") << name;
        }
      }
}

TEST(Outline, VerticesOnEdgesAreSoundToTheLastDigit) {
  for (const double bend : {0.0, 1e-17, -1e-17, 1e-12, -1e-12}) {
    const Points points = support::points({{0, 0}, {1. / 3, bend}, {1, 0}, {1, 1}, {0, 1}});
    for (const BlockModel model : all_shapes) EXPECT_EQ(complaint(points, model), "") << bend;
    EXPECT_NE(complaint(points, BlockModel::wachspress).find("straight corner at vertex 1"),
              std::string::npos);
  }
}

/// An hourglass 2 m wide and high, with a waist of the given width.
Points hourglass(double waist) {
  return support::points({{-1, -1}, {1, -1}, {waist / 2, 0}, {1, 1}, {-1, 1}, {-waist / 2, 0}});
}

/// A square of 2 m with a slit of the given width, and one with a spike.
Points slit(double width, double end) {
  return support::points({{-1, -1}, {1, -1}, {1, 1}, {width / 2, 1}, {0, end}, {-width / 2, 1}, {-1, 1}});
}

/// A millionth in a mesh.
TEST(Outline, NecksSlitsAndSpikesMayBeAsNarrowAsABillionthOfTheSize) {
  for (const double size : {1e-5, 1.0, 1e5})
    for (const BlockModel model : all_shapes) {
      const double least = model == BlockModel::mesh ? 1e-6 : 1e-9;
      for (const double width : {1e-2, 1e3 * least, 5 * least}) {
        EXPECT_EQ(complaint(size * hourglass(width), model), "") << size << ' ' << width;
        EXPECT_EQ(complaint(size * slit(width, 0), model), "") << size << ' ' << width;
        EXPECT_EQ(complaint(size * slit(width, 2), model), "") << size << ' ' << width;
      }
      for (const double width : {0.5 * least, 1e-12, 1e-15}) {
        EXPECT_NE(complaint(size * hourglass(width), model).find("passes at vertex"), std::string::npos);
        EXPECT_NE(complaint(size * slit(width, 0), model), "") << size << ' ' << width;
        EXPECT_NE(complaint(size * slit(width, 2), model), "") << size << ' ' << width;
      }
      EXPECT_NE(complaint(size * hourglass(0), model).find("touches itself"), std::string::npos);
      EXPECT_NE(complaint(size * slit(0, 0), model).find("touches itself"), std::string::npos);
      EXPECT_NE(complaint(size * hourglass(-0.1), model).find("intersects itself"), std::string::npos);
    }
  EXPECT_EQ(complaint(hourglass(4e-12), BlockModel::affine),
            "block passes at vertex 2 within 4e-12 m of edge 4");
}

TEST(Outline, ShortEdgesAreNoNecks) {
  for (const double length : {1e-6, 1e-10, 1e-12})
    for (const BlockModel model : {BlockModel::automatic, BlockModel::wachspress})
      EXPECT_EQ(complaint(support::points({{0, 0}, {1, 0}, {1, 1 - length}, {1 - length, 1}, {0, 1}}), model),
                "");
}

TEST(Outline, DistanceOutsideAConcaveBlockIsThatToTheNearestPoint) {
  ProblemList problems("test");
  for (const auto& [name, polygon] : support::concave_polygons()) {
    const CheckedOutline checked =
        check_outline(outline_of(polygon), BlockModel::automatic, {}, "block", problems);
    if (name == "L") {
      EXPECT_DOUBLE_EQ(checked.distance_outside(Vec2(1.5, 1.25)), 0.25);
      EXPECT_DOUBLE_EQ(checked.distance_outside(Vec2(5, 5)), 5);
      EXPECT_EQ(checked.distance_outside(Vec2(1, 1)), 0);
      EXPECT_EQ(checked.distance_outside(Vec2(0.5, 1.9)), 0);
    }
    if (name == "deep notch") {
      EXPECT_NEAR(checked.distance_outside(Vec2(1, 2)), 0.1986, 1e-4);
    }
  }
}

TEST(Outline, DistanceBetweenOutlinesIsThatOfTheirNearestPoints) {
  const Points l = support::points({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});
  const auto square = [](double x, double y, double side) {
    return support::points({{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}});
  };
  EXPECT_EQ(distance_between(l, square(1, 1, 1)), 0) << "in the notch";
  EXPECT_DOUBLE_EQ(distance_between(l, square(1.25, 1.5, 0.5)), 0.25) << "hanging in the notch";
  EXPECT_DOUBLE_EQ(distance_between(l, square(5, 5, 1)), 5);
  EXPECT_EQ(distance_between(l, square(0.25, 0.25, 0.5)), 0) << "inside";
  EXPECT_EQ(distance_between(square(-1, -1, 9), l), 0) << "around";
}

TEST(Outline, PointsOfLoadsAndMonitorsMayNotLieInANotch) {
  const std::string text = replaced(minimal, "[[0, 0], [1, 0], [1, 1], [0, 1]]",
                                    "[[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]]") +
                           "[[monitor]]\nname = \"m\"\nblock = 0\nat = [0.5, 1.5]\n" +
                           "[[load]]\ntype = \"point\"\nblock = 0\nat = [1.0, 1.0]\nforce = [1, 0]\n";
  EXPECT_TRUE(read(text).scene) << all_text(read(text).problems);
  EXPECT_NE(all_text(read(text, {"monitor.m.at=[1.5, 1.25]"}).problems).find("0.25 m outside block 0"),
            std::string::npos);
  EXPECT_NE(all_text(read(text, {"load.0.at=[1.5, 1.25]"}).problems).find("0.25 m outside block 0"),
            std::string::npos);
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
