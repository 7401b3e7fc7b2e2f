// Values against CGAL's barycentric coordinates, by its precise policies.
#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/testing/sample_polygons.hpp>

#include <CGAL/Barycentric_coordinates_2/Mean_value_coordinates_2.h>
#include <CGAL/Barycentric_coordinates_2/Wachspress_coordinates_2.h>
#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

using namespace polyfem;

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using CgalPoints = std::vector<Kernel::Point_2>;
using CgalWachspress = CGAL::Barycentric_coordinates::Wachspress_coordinates_2<CgalPoints, Kernel>;
using CgalMeanValue = CGAL::Barycentric_coordinates::Mean_value_coordinates_2<CgalPoints, Kernel>;

/// The largest difference at points inside.
template <class CgalCoordinates>
double largest_difference(const Basis& basis, const Points& polygon) {
  const Points points = inner_points(polygon, 50);
  ShapeTable ours;
  basis.evaluate(polygon, points, ours);
  CgalPoints vertices;
  for (const Vec2 v : polygon.colwise()) vertices.emplace_back(v.x(), v.y());
  CgalCoordinates coordinates(vertices, CGAL::Barycentric_coordinates::Computation_policy_2::PRECISE);
  double largest = 0;
  for (Index q = 0; q < points.cols(); ++q) {
    std::vector<double> theirs;
    coordinates(Kernel::Point_2(points(0, q), points(1, q)), std::back_inserter(theirs));
    for (Index i = 0; i < polygon.cols(); ++i)
      largest = std::max(largest, std::abs(ours.values(q, i) - theirs[static_cast<std::size_t>(i)]));
  }
  return largest;
}

TEST(Cgal, HasTheSameWachspressFunctions) {
  for (const SamplePolygon& sample : sample_polygons(SampleShapes::strictly_convex, 50))
    EXPECT_LT(largest_difference<CgalWachspress>(wachspress, sample.vertices), 1e-14) << sample.name;
}

/// Theirs lose digits where an angle comes near pi: 1e-13 in a star of 100 vertices.
TEST(Cgal, HasTheSameMeanValueFunctions) {
  for (const SamplePolygon& sample : sample_polygons(SampleShapes::simple, 100))
    EXPECT_LT(largest_difference<CgalMeanValue>(mean_value, sample.vertices), 1e-12) << sample.name;
}

}  // namespace
