#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/triangulation.hpp>
#include <polyfem/quadrature/adjoint_bound.hpp>
#include <polyfem/quadrature/gauss_rule.hpp>
#include <polyfem/quadrature/graded_rule.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace polyfem {
namespace {

/// Nearer singularities are at the end of the line.
constexpr double shortest_reach = 1e-9;

struct WeightedPoint {
  double x, y, weight;
};

void write(const std::vector<WeightedPoint>& entries, const Vec2& origin, PolygonRule& rule) {
  const Index n = static_cast<Index>(entries.size());
  rule.points.resize(2, n);
  rule.weights.resize(n);
  for (Index q = 0; q < n; ++q) {
    const WeightedPoint& entry = entries[static_cast<std::size_t>(q)];
    rule.points.col(q) = origin + Vec2(entry.x, entry.y);
    rule.weights[q] = entry.weight;
  }
}

Reach nearer(const Reach& a, const Reach& b) {
  return {std::min(a.before, b.before), std::min(a.behind, b.behind)};
}

/// Poles on the lines Im u = +-pi.
double axis_of_real_poles(const GradedMap& map) {
  const double y = std::numbers::pi / map.length();
  return std::sqrt(1 + 4 * y * y);
}

/// Singularities outside of the adjoint's bound.
class AdjointPoles {
 public:
  explicit AdjointPoles(const PointsRef& polygon) : bound_(polygon) {}
  Reach reach(const Vec2& p, const Vec2& q) const { return {bound_.reach(q, p), bound_.reach(p, q)}; }
  double axis(const Vec2&, const Vec2&, const Reach&, const GradedMap& map) const {
    return axis_of_real_poles(map);
  }

 private:
  AdjointBound bound_;
};

/// Singularities at the vertices x_j of a polygon, that is on any line where (x - x_j)^2 = 0: off the real
/// line by the distance of x_j. Lines are given relative to an origin, a vertex if need be: next to it
/// absolute points would coincide.
class VertexSingularities {
 public:
  explicit VertexSingularities(const PointsRef& vertices) : vertices_(vertices) {}
  void set_origin(const Vec2& origin) { origin_ = origin; }
  /// From now on lines start at vertex i, the origin, where the collapse takes the singularity away. What is
  /// left of it lies behind the vertex, and the nearer the less a reflex corner leaves outside: mean value
  /// weights there go as cot(angle / 4) / r + const.
  void collapse_at(Index i) {
    const Index n = vertices_.cols();
    const Vec2 a = vertices_.col((i + 1) % n) - vertices_.col(i),
               b = vertices_.col((i + n - 1) % n) - vertices_.col(i);
    const double angle = std::atan2(cross(a, b), a.dot(b));
    layer_ = angle > 0 ? 1 : 0.4 / std::tan((angle + 2 * std::numbers::pi) / 4);
    collapsed_ = i;
    origin_ = vertices_.col(i);
  }

  Reach reach(const Vec2& p, const Vec2& q) const {
    Reach reach{1e6, 1e6};
    const double length = (q - p).norm();
    for (Index j = 0; j < vertices_.cols(); ++j) {
      if (j == collapsed_) continue;
      const Vec2 vertex = vertices_.col(j) - origin_;
      reach = nearer(reach, {(vertex - p).norm() / length, (vertex - q).norm() / length});
    }
    reach.before *= layer_;
    // An ear's side may have a straight vertex just at its middle.
    return {std::max(reach.before, shortest_reach), std::max(reach.behind, shortest_reach)};
  }
  double axis(const Vec2& p, const Vec2& q, const Reach& reach, const GradedMap& map) const {
    using Complex = std::complex<double>;
    const double length = map.length(), first = std::log(map.first());
    double axis = axis_of_real_poles(map);
    for (Index j = 0; j < vertices_.cols(); ++j) {
      if (j == collapsed_) continue;
      const Vec2 r = vertices_.col(j) - origin_ - p, line = q - p;
      const Complex t = Complex(r.dot(line), std::abs(cross(line, r))) / line.squaredNorm();
      const Complex u = std::log((t + reach.before) / (1 + reach.behind - t)) - first;
      axis = std::min(axis, (std::abs(u) + std::abs(u - length)) / length);
    }
    return std::max(axis, 1.001);
  }

 private:
  PointsRef vertices_;
  Vec2 origin_ = Vec2::Zero();
  Index collapsed_ = -1;
  double layer_ = 1;
};

/// The triangle (apex, apex + p, apex + q).
struct ApexTriangle {
  Vec2 apex, p, q;
};

/// The triangle as the image of a square whose side s = 0 is the apex, about which the singularities are
/// given.
template <class Singularities>
void add_collapsed(const ApexTriangle& triangle, const Singularities& outwards, const Singularities& along,
                   double digits, std::vector<WeightedPoint>& rule) {
  const auto& [apex, p, q] = triangle;
  const Vec2 zero = Vec2::Zero();
  const Reach reach = nearer(outwards.reach(zero, p), outwards.reach(zero, q));
  const GradedMap map(reach);
  const double axis = std::min(outwards.axis(zero, p, reach, map), outwards.axis(zero, q, reach, map));
  const GaussRule& gauss = gauss_rule(n_gauss_points(digits, axis));
  const double area = cross(p, q);
  for (Index i = 0; i < gauss.points.size(); ++i) {
    const auto [s, ds] = map(gauss.points[i]);
    const Vec2 from = s * p, to = s * q;
    const Reach reach_along = along.reach(from, to);
    const GradedMap map_along(reach_along);
    const GaussRule& gauss_along =
        gauss_rule(n_gauss_points(digits, along.axis(from, to, reach_along, map_along)));
    for (Index j = 0; j < gauss_along.points.size(); ++j) {
      const auto [t, dt] = map_along(gauss_along.points[j]);
      const Vec2 x = apex + (from + t * (to - from));
      rule.push_back({x.x(), x.y(), gauss.weights[i] * gauss_along.weights[j] * ds * dt * s * area});
    }
  }
}

/// A quadrilateral as the bilinear image of a square, on which the lines of two sides bound the reach of all
/// between them.
void make_graded_quadrilateral_rule(const PointsRef& v, const AdjointPoles& poles, double digits,
                                    PolygonRule& rule) {
  thread_local GaussRule along_0, along_1;
  const auto make = [&](const Reach& reach, GaussRule& gauss) {
    const GradedMap map(reach);
    make_graded_gauss_rule(n_gauss_points(digits, axis_of_real_poles(map)), map, gauss);
  };
  make(nearer(poles.reach(v.col(0), v.col(1)), poles.reach(v.col(3), v.col(2))), along_0);
  make(nearer(poles.reach(v.col(0), v.col(3)), poles.reach(v.col(1), v.col(2))), along_1);
  make_quadrilateral_rule(v, along_0, along_1, rule);
}

}  // namespace

void make_adjoint_rule(const PointsRef& polygon, double digits, PolygonRule& rule) {
  const Index n = polygon.cols();
  const Vec2 centroid = area_moments(polygon).centroid;
  const Points local = polygon.colwise() - centroid;
  const AdjointPoles poles(local);
  if (n == 4) {
    make_graded_quadrilateral_rule(local, poles, digits, rule);
    rule.points.colwise() += centroid;
    return;
  }
  thread_local std::vector<WeightedPoint> entries;
  entries.clear();
  for (Index k = 0; k < n; ++k)
    add_collapsed({Vec2::Zero(), local.col(k), local.col((k + 1) % n)}, poles, poles, digits, entries);
  write(entries, centroid, rule);
}

void make_vertex_rule(const PointsRef& polygon, double digits, PolygonRule& rule) {
  const Index n = polygon.cols();
  const Vec2 origin = area_moments(polygon).centroid;
  const Points local = polygon.colwise() - origin;
  VertexSingularities elsewhere(local);
  VertexSingularities anywhere(local);
  thread_local std::vector<WeightedPoint> entries;
  entries.clear();
  // The half at vertex i of the triangle (centre, i, j), where i may stand before j or behind.
  const auto add_half = [&](Index i, Index j, const Vec2& centre, bool before) {
    const Vec2 vertex = local.col(i), middle = (local.col(j) - vertex) / 2, inwards = centre - vertex;
    elsewhere.collapse_at(i);
    anywhere.set_origin(vertex);
    add_collapsed({vertex, before ? middle : inwards, before ? inwards : middle}, elsewhere, anywhere, digits,
                  entries);
  };
  const auto add_side = [&](Index i, Index j, const Vec2& centre) {
    add_half(i, j, centre, true);
    add_half(j, i, centre, false);
  };
  if (is_star_shaped(local, Vec2::Zero())) {
    for (Index k = 0; k < n; ++k) add_side(k, (k + 1) % n, Vec2::Zero());
  } else {
    const Triangles ears = triangulate(local);
    for (const auto& ear : ears.colwise()) {
      const Vec2 centre = (local.col(ear[0]) + local.col(ear[1]) + local.col(ear[2])) / 3;
      for (Index k = 0; k < 3; ++k) add_side(ear[k], ear[(k + 1) % 3], centre);
    }
  }
  write(entries, origin, rule);
}

}  // namespace polyfem
