/// \file What a basis of shape functions on a polygon is.
#pragma once

#include <polyfem/core/types.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace polyfem {

/// Shape functions at one point, one entry a vertex in the polygon's order.
struct ShapeValues {
  VectorXd values;   ///< N_i(x)
  Points gradients;  ///< grad N_i(x), one a column, in 1/length
};

/// n shape functions at q points: one row a point, one column a vertex.
struct ShapeTable {
  MatrixXd values;  ///< N_i(x_q), q x n
  MatrixXd dx, dy;  ///< derivatives of N_i at x_q, q x n, in 1/length

  Index n_vertices() const { return values.cols(); }
  Index n_points() const { return values.rows(); }
};

/// Why a basis cannot be used on a polygon.
struct Rejection {
  int vertex;          ///< where it shows
  std::string reason;  ///< with the cure, to follow "vertex 3 "
};

/// One shape function a vertex, with N_i = 1 at vertex i and 0 at the others, linear on edges, and
/// reproducing what is linear in x: everything else in this library rests on these properties alone.
class Basis {
 public:
  /// One word, for reports.
  virtual std::string_view name() const = 0;

  /// What forbids this basis on a simple counter-clockwise polygon; nothing when it can be used. Whether the
  /// polygon is simple and counter-clockwise is not looked at: see `find_defect`.
  virtual std::optional<Rejection> find_rejection(const PointsRef& polygon) const = 0;

  /// Values and gradients at points of the closed polygon, one a column of `points`; many points at once
  /// cost less each. Reuses the table's storage. May throw Error when the polygon is unsuitable, as
  /// Wachspress functions do; no basis has to look.
  virtual void evaluate(const PointsRef& polygon, const PointsRef& points, ShapeTable& table) const = 0;

  /// Values and gradients at one point.
  void operator()(const PointsRef& polygon, const Vec2& x, ShapeValues& shape) const;

 protected:
  ~Basis() = default;
};

/// Throws Error with the vertex and the reason when the basis cannot be used on this polygon, which must be
/// simple and counter-clockwise: that is not looked at.
void require_suitable(const Basis& basis, const PointsRef& polygon);

}  // namespace polyfem
