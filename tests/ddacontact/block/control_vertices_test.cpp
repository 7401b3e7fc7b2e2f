#include <ddacontact/block/control_vertices.hpp>
#include <tests/ddacontact/simple_scenes.hpp>
#include <tests/support/concave_polygons.hpp>

#include <gtest/gtest.h>

#include <random>

using namespace support;

namespace {

double doubled_area(const Points& outline, int a, int b, int c) {
  return std::abs(cross(outline.col(b) - outline.col(a), outline.col(c) - outline.col(a)));
}

/// The most held vertices of three that are not on one line.
int most_held(const Points& outline, const std::vector<bool>& held) {
  int most = 0;
  const int n = static_cast<int>(outline.cols());
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < a; ++b)
      for (int c = 0; c < b; ++c)
        if (doubled_area(outline, a, b, c) > 0) most = std::max(most, held[a] + held[b] + held[c]);
  return most;
}

}  // namespace

TEST(ControlVertices, TakeAsManyHeldOnesAsAnAffineFieldFollows) {
  std::mt19937 random(4);
  for (const NamedPolygon& shape : concave_polygons())
    for (int trial = 0; trial < 30; ++trial) {
      const Points& outline = shape.points;
      std::vector<bool> x(static_cast<std::size_t>(outline.cols())), y = x;
      for (std::size_t v = 0; v < x.size(); ++v) {
        x[v] = random() % 3 == 0;
        y[v] = random() % 2 == 0;
      }
      const ControlVertices control = choose_control_vertices(outline, x, y);
      for (const auto& [three, held] : {std::pair{control.x, x}, {control.y, y}}) {
        EXPECT_GT(doubled_area(outline, three[0], three[1], three[2]), 0) << shape.name;
        EXPECT_EQ(held[three[0]] + held[three[1]] + held[three[2]], most_held(outline, held)) << shape.name;
      }
    }
}

TEST(ControlVertices, LieFarApart) {
  const Points outline = points({{0, 0}, {1, 0}, {9, 0}, {10, 0}, {10, 1}, {10, 3}, {0, 3}});
  const std::vector<bool> none(7, false);
  const ControlVertices control = choose_control_vertices(outline, none, none);
  EXPECT_EQ(control.x, control.y);
  EXPECT_EQ(doubled_area(outline, control.x[0], control.x[1], control.x[2]), 30);
}
