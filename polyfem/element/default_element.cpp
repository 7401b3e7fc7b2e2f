#include <polyfem/basis/quadratic_shapes.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/element/default_element.hpp>
#include <polyfem/element/quadratic_element.hpp>
#include <polyfem/geometry/validity.hpp>

namespace polyfem {
namespace {

void make_default_rule(const PointsRef& corners, int n_gauss, PolygonRule& rule) {
  if (corners.cols() == 4 && !find_non_convex_corner(corners))
    make_quadrilateral_rule(corners, n_gauss, rule);
  else
    make_polygon_rule(corners, dunavant_rule(4), rule);
}

}  // namespace

void tabulate(const PointsRef& cell, TabulatedElement& element) {
  thread_local PolygonRule rule;
  if (cell.cols() == 3)
    make_ear_rule(cell, hammer_rule(2), rule);
  else
    make_default_rule(cell, 2, rule);
  tabulate(cell, rule, suitable_basis(cell), GradientCorrection::on, element);
}

void tabulate_quadratic(const PointsRef& cell, TabulatedElement& element) {
  const Points corners = quadratic_corners(cell);
  thread_local PolygonRule rule;
  make_default_rule(corners, 3, rule);
  tabulate_quadratic(cell, rule, suitable_basis(corners), GradientCorrection::on, element);
}

}  // namespace polyfem
