/// \file What a basis promises, and the places it is tried at.
#pragma once

#include <polyfem/basis/basis.hpp>
#include <polyfem/testing/worst_error.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace polyfem {

/// What a basis is good for: what it is tried on, and how it is judged.
struct BasisPromises {
  SampleShapes shapes = SampleShapes::strictly_convex;  ///< what it takes without rejecting it
  /// Error of values, and of gradients over the largest at the point; n / 10 times as much beyond n = 10.
  double tolerance = 1e-14;
  bool affine = false;  ///< follows every affine map, not only translations, turns and changes of scale
  int largest_n = 100;  ///< polygons have at most so many vertices
};

/// Where a basis is evaluated, and the result.
struct BasisSample {
  SamplePolygon polygon;
  Points points;
  ShapeTable table;

  Vec2 x(Index q) const { return points.col(q); }
  double largest_gradient(Index q) const {
    return std::max(table.dx.row(q).cwiseAbs().maxCoeff(), table.dy.row(q).cwiseAbs().maxCoeff());
  }
  /// One column a vertex.
  Points gradients(Index q) const {
    Points result(2, table.n_vertices());
    result << table.dx.row(q), table.dy.row(q);
    return result;
  }
};

/// The fixture of the suite; its type parameter gives the basis and what it promises, see
/// basis_properties.hpp.
template <class Parameter>
class BasisProperties : public ::testing::Test {
 protected:
  const Basis& basis_ = Parameter::basis();
  const BasisPromises promises_ = Parameter::promises();

  double tolerance(const SamplePolygon& polygon) const {
    return promises_.tolerance * std::max(1., static_cast<double>(polygon.vertices.cols()) / 10);
  }
  /// Of a sum over all vertices.
  double sum_tolerance(const SamplePolygon& polygon) const {
    return tolerance(polygon) * static_cast<double>(polygon.vertices.cols());
  }
  BasisSample evaluate(const SamplePolygon& polygon, const Points& points) const {
    BasisSample sample{polygon, points, {}};
    basis_.evaluate(polygon.vertices, points, sample.table);
    return sample;
  }

  using CheckPolygon = std::function<void(const SamplePolygon& polygon)>;
  void for_each_polygon(const CheckPolygon& check) const {
    for (const SamplePolygon& polygon : sample_polygons(promises_.shapes, promises_.largest_n))
      check(polygon);
  }
  /// Points inside and on an edge, `n_smooth_points` of them, then at vertices, where gradients may be a
  /// matter of definition.
  static constexpr Index n_smooth_points = 11;
  static Points places(const SamplePolygon& polygon) {
    const Points inside = inner_points(polygon.vertices, 8), on_edge = edge_points(polygon.vertices, 1);
    Points points(2, inside.cols() + on_edge.cols() + 2);
    points << inside, on_edge, polygon.vertices.leftCols(2);
    return points;
  }
  /// Those, in polygons of sizes from 1e-6 to 1e6 and up to 1e8 times their size away from the origin.
  void for_each_point(const std::function<void(const BasisSample& sample, double size)>& check) const {
    for_each_polygon([&](const SamplePolygon& polygon) {
      const Points points = places(polygon);
      for (const int exponent : {-20, 0, 20})
        for (const double distance : {0., 100., 1e8}) {
          const double size = std::ldexp(1., exponent);  // exact, as is the shift
          const auto placed = [&](const Points& at) -> Points {
            return size * (at.colwise() + Vec2(distance, -distance / 2));
          };
          const std::string name = polygon.name + ", times " + std::to_string(size) +
                                   ", away from the origin by " + std::to_string(distance) +
                                   " times its size";
          check(evaluate({name, placed(polygon.vertices)}, placed(points)), size);
        }
    });
  }

  /// N_i(A x + b) = N_i(x) and grad N_i = A^T grad' N_i; A and b must be such that nothing is rounded.
  void expect_equal_when_mapped(const Mat2& A, const Vec2& b) const {
    WorstError worst_value, worst_gradient;
    for_each_polygon([&](const SamplePolygon& polygon) {
      const auto mapped = [&](const Points& at) -> Points { return (A * at).colwise() + b; };
      const Points points = places(polygon).leftCols(n_smooth_points);
      const BasisSample before = evaluate(polygon, points);
      const BasisSample after = evaluate({polygon.name, mapped(polygon.vertices)}, mapped(points));
      for (Index q = 0; q < points.cols(); ++q) {
        const double value = (after.table.values.row(q) - before.table.values.row(q)).cwiseAbs().maxCoeff();
        const double gradient =
            (A.transpose() * after.gradients(q) - before.gradients(q)).cwiseAbs().maxCoeff();
        worst_value.see(value, 2 * tolerance(polygon), polygon, before.x(q));
        worst_gradient.see(gradient, 8 * tolerance(polygon) * before.largest_gradient(q), polygon,
                           before.x(q));
      }
    });
  }

  /// The properties that hold wherever x is, up to `factor` times the promised errors.
  void expect_consistent(const BasisSample& sample, double factor, WorstError& worst) const {
    const Points& vertices = sample.polygon.vertices;
    const double size = (vertices.colwise() - vertices.col(0)).colwise().norm().maxCoeff();
    const double allowed = factor * sum_tolerance(sample.polygon);
    for (Index q = 0; q < sample.points.cols(); ++q) {
      const Points from_x = vertices.colwise() - sample.x(q), gradients = sample.gradients(q);
      const double scale = sample.largest_gradient(q);
      const auto see = [&](double error, double of) {
        worst.see(error, allowed * of, sample.polygon, sample.x(q));
      };
      see(std::abs(sample.table.values.row(q).sum() - 1), 1);
      see((from_x * sample.table.values.row(q).transpose()).norm(), size);
      see(gradients.rowwise().sum().norm(), scale);
      see((from_x * gradients.transpose() - Mat2::Identity()).norm(), size * scale);
    }
  }
};

}  // namespace polyfem
