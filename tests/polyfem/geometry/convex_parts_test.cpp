#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/convex_parts.hpp>
#include <polyfem/geometry/corner_turn.hpp>
#include <polyfem/geometry/diagonals.hpp>
#include <polyfem/geometry/predicates.hpp>
#include <polyfem/geometry/validity.hpp>
#include <tests/support/concave_polygons.hpp>
#include <tests/support/overlap_area.hpp>
#include <tests/support/random_polygon.hpp>
#include <tests/support/random_simple_polygon.hpp>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <limits>
#include <numeric>

namespace {

using namespace polyfem;

Points columns(const Points& polygon, const std::vector<int>& part) {
  Points points(2, static_cast<Index>(part.size()));
  for (std::size_t k = 0; k < part.size(); ++k) points.col(static_cast<Index>(k)) = polygon.col(part[k]);
  return points;
}

int n_reflex(const Points& polygon) {
  int n = 0;
  for (Index k = 0; k < polygon.cols(); ++k)
    if (orientation(polygon.col((k + polygon.cols() - 1) % polygon.cols()), polygon.col(k),
                    polygon.col((k + 1) % polygon.cols())) < 0)
      ++n;
  return n;
}

/// Parts of a polygon that are convex, lie in it, do not overlap and have its area.
std::vector<std::vector<int>> sound_parts(const Points& polygon, double least_turn = 1e-9) {
  const auto parts = convex_parts(polygon, least_turn);
  double area = 0;
  std::vector<Points> outlines;
  for (const auto& part : parts) outlines.push_back(columns(polygon, part));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    EXPECT_FALSE(find_defect(outlines[i]));
    EXPECT_FALSE(find_non_convex_corner(outlines[i], least_turn));
    area += signed_area(outlines[i]);
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_LT(support::overlap_area(outlines[i], outlines[j]), 1e-13 * signed_area(polygon));
  }
  EXPECT_NEAR(area, signed_area(polygon), 1e-13 * signed_area(polygon));
  return parts;
}

/// The least number of convex parts, by trying every diagonal at the first reflex corner.
int fewest_parts(const Points& polygon, const std::vector<int>& corners) {
  const int n = static_cast<int>(corners.size());
  for (int k = 0; k < n; ++k) {
    if (orientation(polygon.col(corners[(k + n - 1) % n]), polygon.col(corners[k]),
                    polygon.col(corners[(k + 1) % n])) >= 0)
      continue;
    int fewest = std::numeric_limits<int>::max();
    for (int end = 0; end < n; ++end) {
      const int apart = std::abs(end - k);
      if (apart < 2 || apart > n - 2 || !is_diagonal(polygon, corners, k, end)) continue;
      const auto [part, rest] = split_at(corners, k, end);
      fewest = std::min(fewest, fewest_parts(polygon, part) + fewest_parts(polygon, rest));
    }
    return fewest;
  }
  return 1;
}

int fewest_parts(const Points& polygon) {
  std::vector<int> corners(static_cast<std::size_t>(polygon.cols()));
  std::iota(corners.begin(), corners.end(), 0);
  return fewest_parts(polygon, corners);
}

TEST(ConvexParts, OfAConvexPolygonAreItself) {
  std::mt19937 random(1);
  for (const int n : {3, 4, 9, 30}) {
    const Points polygon = support::random_convex_polygon(n, random);
    const auto parts = sound_parts(polygon);
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(columns(polygon, parts[0]), polygon);
  }
}

TEST(ConvexParts, OfKnownShapesAreAsFewAsPossible) {
  const std::vector<std::pair<std::string, std::size_t>> known{
      {"dart", 2}, {"square with middles", 1}, {"triangle with a middle", 1}, {"chevron", 2}, {"L", 2},
      {"comb", 4}, {"deep notch", 3},          {"U with straight corners", 3}};
  for (const auto& [name, polygon] : support::concave_polygons())
    for (const double angle : {0.0, 0.4})
      for (const double size : {1e-3, 1.0, 1e5}) {
        const Points placed = (Eigen::Rotation2Dd(angle).toRotationMatrix() * size * polygon).colwise() +
                              Vec2(10 * size, -20 * size);
        const auto parts = sound_parts(placed);
        for (const auto& [of, n] : known)
          if (of == name) {
            EXPECT_EQ(parts.size(), n) << name << ' ' << angle;
          }
      }
}

TEST(ConvexParts, VerticesOnEdgesMakeNoCutAndAreLeftOut) {
  const Points polygon = support::points({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}});
  for (const double least_turn : {0.0, 1e-9}) {
    const auto parts = sound_parts(polygon, least_turn);
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0], (std::vector<int>{0, 2, 4, 6}));
  }
}

TEST(ConvexParts, OfRandomPolygonsAreConvexAndFillThem) {
  std::mt19937 random(7);
  for (int i = 0; i < 300; ++i) {
    const int n = 4 + i % 30;
    for (const Points& polygon :
         {support::random_star(n, random), support::random_simple_polygon(std::min(n, 20), random)}) {
      const auto parts = sound_parts(polygon, i % 2 ? 1e-9 : 0.0);
      EXPECT_LE(static_cast<int>(parts.size()), 2 * n_reflex(polygon) + 1);
    }
  }
}

TEST(ConvexParts, OfPolygonsOnAGridFillThemExactly) {
  // Vertices on edges, parallel edges, cuts in line with edges: whatever is not in general position.
  std::mt19937 random(13);
  for (int i = 0; i < 400; ++i) {
    Points polygon = support::points({{0, 0}, {6, 0}, {0, 6}});
    for (int tries = 0; tries < 300 && polygon.cols() < 5 + i % 20; ++tries) {
      const Points finer =
          support::with_vertex(polygon, std::uniform_int_distribution<Index>(0, polygon.cols() - 1)(random),
                               Vec2(static_cast<double>(random() % 7), static_cast<double>(random() % 7)));
      if (!find_defect(finer) && signed_area(finer) > 0) polygon = finer;
    }
    double area = 0;
    for (const auto& part : sound_parts(polygon, 0)) area += signed_area(columns(polygon, part));
    EXPECT_EQ(area, signed_area(polygon));
  }
}

TEST(ConvexParts, AreNearlyAsFewAsPossible) {
  std::mt19937 random(11);
  int n_parts = 0, n_fewest = 0;
  for (int i = 0; i < 200; ++i)
    for (const Points& polygon :
         {support::random_star(7 + i % 7, random), support::random_simple_polygon(7 + i % 7, random)}) {
      const int parts = static_cast<int>(sound_parts(polygon).size()), fewest = fewest_parts(polygon);
      EXPECT_GE(parts, fewest);
      EXPECT_LE(parts, fewest + 2);
      n_parts += parts;
      n_fewest += fewest;
    }
  EXPECT_LT(n_parts, 1.04 * n_fewest);
}

TEST(ConvexParts, AvoidSliversWhereTheyCan) {
  // The corner of the notch may be joined to any of the corners below; only one leaves no thin part.
  const Points polygon = support::points(
      {{0, 0}, {1, 0}, {2, 0.01}, {3, 0}, {4, 0}, {4, 2}, {2.2, 2}, {2, 1}, {1.8, 2}, {0, 2}});
  for (const auto& part : sound_parts(polygon)) {
    const Points outline = columns(polygon, part);
    const double turn =
        least_turn(static_cast<int>(outline.cols()), [&](int k) -> Vec2 { return outline.col(k); });
    EXPECT_GT(turn, 0.005);
  }
}

TEST(ConvexParts, OfManyVerticesAreSoundToo) {
  std::mt19937 random(3);
  EXPECT_GT(sound_parts(support::random_star(200, random)).size(), 40u);
}

}  // namespace
