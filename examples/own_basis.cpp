// A basis of one's own: a class derived from polyfem::Basis.
//
//        4-------3      The polygon is cut into triangles about the mean c of its n vertices. Fields are
//       / \     / \     linear in each, and their value at c is the mean of the vertices' values, so that
//      /   \   /   2    c adds no unknown: N_i = L_i + L_c / n, with the area coordinates L of the
//     /      c  . /     triangle that x lies in. What is linear in x is reproduced, and N_i is linear on
//    /   .     \ /      edges: that is all `tabulate` asks for.
//   0-----------1
//                       The gradients jump between the triangles, and the library's quadrature, whose
// triangles meet at the centroid instead, integrates them badly: a uniform stress is not in equilibrium
// with its tractions (the patch test). The gradient correction mends that to round-off.
//
// polyfem/testing/basis_properties.hpp is a suite of tests for bases of one's own; this one passes it.
#include <polyfem/element/matrices.hpp>
#include <polyfem/material/linear_elastic.hpp>

#include <iostream>
#include <tuple>

using namespace polyfem;

class PiecewiseLinear final : public Basis {
 public:
  std::string_view name() const override { return "piecewise_linear"; }
  /// Nothing is wrong with a polygon that is star-shaped about the mean of its vertices, as convex ones are.
  std::optional<Rejection> find_rejection(const PointsRef& polygon) const override {
    const Vec2 c = polygon.rowwise().mean();
    for (int i = 0; i < polygon.cols(); ++i)
      if (cross(polygon.col(i) - c, polygon.col((i + 1) % polygon.cols()) - c) <= 0)
        return Rejection{i, "and the next cannot both be seen from the mean of the vertices"};
    return std::nullopt;
  }
  void evaluate(const PointsRef& polygon, const PointsRef& points, ShapeTable& table) const override {
    for (MatrixXd* N : {&table.values, &table.dx, &table.dy}) N->resize(points.cols(), polygon.cols());
    for (Index q = 0; q < points.cols(); ++q) evaluate_at(polygon, points.col(q), q, table);
  }

 private:
  static void evaluate_at(const PointsRef& polygon, const Vec2& x, Index row, ShapeTable& table) {
    const Index n = polygon.cols();
    const Points vertices = polygon.colwise() - x;  // as seen from x: no digits are lost far from the origin
    const Vec2 c = vertices.rowwise().mean(), r = -c;
    for (Index i = 0; i < n; ++i) {
      const Index next = (i + 1) % n;
      const Vec2 p = vertices.col(i) - c, q = vertices.col(next) - c;
      if (cross(p, r) < 0 || cross(r, q) < 0) continue;  // x is not between the rays through p and q
      const double doubled_area = cross(p, q);
      const Vec2 grad_p = Vec2(q.y(), -q.x()) / doubled_area, grad_q = Vec2(-p.y(), p.x()) / doubled_area;
      const double L_p = grad_p.dot(r), L_q = grad_q.dot(r);
      const Vec2 grad_c = -(grad_p + grad_q) / static_cast<double>(n);
      table.values.row(row).setConstant((1 - L_p - L_q) / static_cast<double>(n));
      table.dx.row(row).setConstant(grad_c.x());
      table.dy.row(row).setConstant(grad_c.y());
      for (const auto& [vertex, L, grad] : {std::tuple(i, L_p, grad_p), std::tuple(next, L_q, grad_q)}) {
        table.values(row, vertex) += L;
        table.dx(row, vertex) += grad.x();
        table.dy(row, vertex) += grad.y();
      }
      return;
    }
  }
};

/// How far the nodal forces of a uniform stress are from those of its tractions, relative to the latter.
double patch_test_residual(const Points& polygon, GradientCorrection correction) {
  Mat2 sigma;
  sigma << 3, 2, 2, -1;
  TabulatedElement element;
  tabulate(polygon, dunavant_rule(5), PiecewiseLinear(), correction, element);
  VectorXd f(2 * polygon.cols()), exact = VectorXd::Zero(2 * polygon.cols());
  const Vec3 stress(sigma(0, 0), sigma(1, 1), sigma(0, 1));
  stress_forces(element, stress.replicate(1, element.n_points()), f);
  for (Index k = 0; k < polygon.cols(); ++k) {
    const Index next = (k + 1) % polygon.cols();
    const Vec2 edge = polygon.col(next) - polygon.col(k);
    const Vec2 force = sigma * Vec2(edge.y(), -edge.x());  // half of it to each end
    exact.segment<2>(2 * k) += force / 2;
    exact.segment<2>(2 * next) += force / 2;
  }
  return (f - exact).norm() / exact.norm();
}

int main() {
  Points polygon(2, 5);
  polygon << 0, 3, 4, 3, 1,  //
      0, 0, 1.5, 3, 3;
  const double raw = patch_test_residual(polygon, GradientCorrection::off);
  const double corrected = patch_test_residual(polygon, GradientCorrection::on);
  std::cout << "patch test: residual " << raw << " as integrated, " << corrected
            << " with corrected gradients\n";
  return raw > 1e-3 && corrected < 1e-14 ? 0 : 1;
}
