// The patch test of every rule, basis and correction, on cells of every kind, near the origin and far from
// it: the weights sum to the area, and a linear displacement field has its constant stress at every
// integration point and its tractions as nodal forces, a rotation none. The forces need the gradient
// correction; without it their errors are those of the rule.
#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/definiteness.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/element/tolerance.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/corner_turn.hpp>
#include <polyfem/geometry/validity.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/quadrature/graded_rule.hpp>
#include <tests/support/concave_polygons.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

using namespace polyfem;

namespace {

/// A way to tabulate a basis on a polygon.
struct Rule {
  std::string name;
  std::function<void(const PointsRef&, const Basis&, GradientCorrection, TabulatedElement&)> tabulate;
  bool full_rank = true;  ///< points enough for every deformation
  std::function<bool(const PointsRef&)> serves = [](const PointsRef&) { return true; };
};

bool is_convex(const PointsRef& polygon) {
  return !find_non_convex_corner(polygon);
}

/// One point a triangle has full rank, but on a cell of 1000:1 too little energy to tell it from none.
Rule on_triangles(const std::string& name, const TriangleRule& rule) {
  return {name,
          [rule](const PointsRef& polygon, const Basis& basis, GradientCorrection correction,
                 TabulatedElement& element) { tabulate(polygon, rule, basis, correction, element); },
          rule.weights.size() > 1};
}

/// Points placed by `make` on the polygon as a whole.
Rule on_polygon(const std::string& name, const std::function<void(const PointsRef&, PolygonRule&)>& make) {
  return {name, [make](const PointsRef& polygon, const Basis& basis, GradientCorrection correction,
                       TabulatedElement& element) {
            PolygonRule rule;
            make(polygon, rule);
            tabulate(polygon, rule, basis, correction, element);
          }};
}

/// All rules of the library.
std::vector<Rule> all_rules() {
  std::vector<Rule> rules;
  for (int degree = 1; degree <= 5; ++degree)
    rules.push_back(on_triangles("Hammer " + std::to_string(degree), hammer_rule(degree)));
  for (int degree = 6; degree <= 20; ++degree)
    rules.push_back(on_triangles("Dunavant " + std::to_string(degree), dunavant_rule(degree)));
  for (const auto& [across, along, grading] :
       {std::array{1, 1, 1}, {3, 2, 1}, {8, 8, 1}, {6, 3, 2}, {12, 12, 2}})
    rules.push_back(on_triangles("collapsed Gauss " + std::to_string(across) + " x " + std::to_string(along) +
                                     " graded " + std::to_string(grading),
                                 collapsed_gauss_rule(across, along, grading)));
  for (int degree = 2; degree <= 5; ++degree)
    rules.push_back(on_polygon("Hammer " + std::to_string(degree) + " on ears",
                               [degree](const PointsRef& polygon, PolygonRule& rule) {
                                 make_ear_rule(polygon, hammer_rule(degree), rule);
                               }));
  for (int n_gauss = 1; n_gauss <= 4; ++n_gauss) {
    rules.push_back(on_polygon("Gauss " + std::to_string(n_gauss) + " x " + std::to_string(n_gauss),
                               [n_gauss](const PointsRef& polygon, PolygonRule& rule) {
                                 make_quadrilateral_rule(polygon, n_gauss, rule);
                               }));
    rules.back().full_rank = n_gauss > 1;
    rules.back().serves = [](const PointsRef& polygon) { return polygon.cols() == 4 && is_convex(polygon); };
  }
  for (const double digits : {2., 6., 20.}) {
    rules.push_back(on_polygon(
        "adjoint rule of " + std::to_string(digits) + " digits",
        [digits](const PointsRef& polygon, PolygonRule& rule) { make_adjoint_rule(polygon, digits, rule); }));
    rules.back().serves = is_convex;
    rules.push_back(on_polygon(
        "vertex rule of " + std::to_string(digits) + " digits",
        [digits](const PointsRef& polygon, PolygonRule& rule) { make_vertex_rule(polygon, digits, rule); }));
  }
  for (const double tolerance : {0.5, 1e-1, 1e-3, 1e-6})
    rules.push_back({"tolerance " + testing::PrintToString(tolerance),
                     [tolerance](const PointsRef& polygon, const Basis& basis, GradientCorrection correction,
                                 TabulatedElement& element) {
                       tabulate_to_tolerance(polygon, basis, tolerance, correction, element);
                     }});
  return rules;
}

struct Cell {
  std::string name;
  Points polygon;
};

/// Polygons with their first vertex at the origin.
std::vector<Cell> cells_of(const std::string& kind) {
  std::vector<Cell> cells;
  const auto add = [&](const std::string& name, const Points& polygon) {
    cells.push_back({name + " " + std::to_string(polygon.cols()), polygon.colwise() - polygon.col(0)});
  };
  std::mt19937 random(22);
  if (kind == "regular")
    for (const int n : {3, 4, 5, 6, 8, 12}) add(kind, support::regular_polygon(n));
  if (kind == "random")
    for (const int n : {3, 4, 5, 6, 8, 12})
      for (int trial = 0; trial < 4; ++trial) add(kind, support::random_convex_polygon(n, random));
  if (kind == "thin")
    for (const int n : {3, 4, 5, 8}) {
      Points polygon = support::random_convex_polygon(n, random);
      polygon.row(1) *= 1e-3;
      add(kind, polygon);
    }
  if (kind == "nearly_straight")
    for (const double turn : {0.1, 2e-3, 1e-5})
      add(kind, support::points({{0, 0}, {0.5, -turn / 4}, {1, 0}, {1, 1}, {0, 1}}));
  if (kind == "vertex_on_edge") {
    add(kind, support::points({{0, 0}, {0.5, 0}, {1, 0}, {1, 1}, {0, 1}}));
    add(kind, support::points({{0, 0}, {0.01, 0}, {1, 0}, {1, 1}, {0, 1}}));
    add(kind, support::points({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}));
  }
  if (kind == "concave")
    for (const auto& [name, polygon] : support::concave_polygons())
      if (!is_convex(polygon)) add(name, polygon);
  return cells;
}

/// What is left of the patch test, relative to the sizes of the terms that cancel.
struct Residuals {
  double area = 0, stress = 0, forces = 0;
  int zero_modes = 0;  ///< of K
};

Residuals patch_residuals(const Points& polygon, const TabulatedElement& element) {
  const Mat3 D = elasticity_matrix(1, 0.3, Plane::strain);
  const Points local = polygon.colwise() - polygon.col(0);
  MatrixXd K, M;
  stiffness(element, D, K);
  mass(element, M);
  Residuals worst;
  worst.area = std::abs(element.rule.weights.sum() / signed_area(local) - 1);
  worst.zero_modes = judge(K, M).zero_modes;
  Mat2 gradients[4];
  gradients[0] << 1, 0, 0, 0;
  gradients[1] << 0, 0, 0, 1;
  gradients[2] << 0, 0.3, 0.7, 0;
  gradients[3] << 0, -1, 1, 0;
  for (const Mat2& G : gradients) {
    const Points u = G * local;
    const VectorXd d = u.reshaped();
    const Vec3 strain(G(0, 0), G(1, 1), G(0, 1) + G(1, 0)), stress = D * strain;
    Tensors at_points;
    strains(element, d, at_points);
    const MatrixXd terms = (element.dx.cwiseAbs() + element.dy.cwiseAbs()) * u.cwiseAbs().transpose();
    worst.stress =
        std::max(worst.stress, (D * (at_points.colwise() - strain)).cwiseAbs().maxCoeff() / terms.maxCoeff());

    VectorXd f = VectorXd::Zero(d.size());
    Mat2 sigma;
    sigma << stress[0], stress[2], stress[2], stress[1];
    for (Index i = 0; i < polygon.cols(); ++i) f.segment<2>(2 * i) = sigma * boundary_integral(polygon, i);
    worst.forces =
        std::max(worst.forces, (K * d - f).cwiseAbs().maxCoeff() / (K.cwiseAbs() * d.cwiseAbs()).maxCoeff());
  }
  return worst;
}

/// Rounding of Wachspress functions grows as a corner straightens: about eps / turn.
double round_off(const Basis& basis, const Points& polygon) {
  const double turn = &basis == &wachspress ? least_turn(static_cast<int>(polygon.cols()),
                                                         [&](int k) -> Vec2 { return polygon.col(k); })
                                            : 1;
  return 200 * std::numeric_limits<double>::epsilon() / turn;
}

/// A kind of cells, and how far from the origin in sizes of the cell.
class PatchTestOfAll : public testing::TestWithParam<std::tuple<std::string, double>> {
 protected:
  /// Calls `look(rule, basis, polygon, element)` for all that can be put together.
  template <class Look>
  void for_each(GradientCorrection correction, const Look& look) {
    const auto& [kind, offset] = GetParam();
    const std::vector<Rule> rules = all_rules();
    TabulatedElement element;
    for (const Cell& cell : cells_of(kind)) {
      const double size = cell.polygon.colwise().norm().maxCoeff();
      const Points polygon = cell.polygon.colwise() + offset * size * Vec2(1, -0.7);
      for (const Basis* basis :
           {static_cast<const Basis*>(&wachspress), static_cast<const Basis*>(&mean_value)})
        for (const Rule& rule : rules) {
          if (!rule.serves(polygon) || basis->find_rejection(polygon)) continue;
          SCOPED_TRACE(cell.name + ", " + std::string(basis->name()) + ", " + rule.name);
          rule.tabulate(polygon, *basis, correction, element);
          look(rule, *basis, polygon, element);
        }
    }
  }
};
std::string name_of(const testing::TestParamInfo<std::tuple<std::string, double>>& of) {
  const auto& [kind, offset] = of.param;
  return kind + "_at_" + std::to_string(static_cast<int>(offset)) + "_sizes";
}
INSTANTIATE_TEST_SUITE_P(Cells, PatchTestOfAll,
                         testing::Combine(testing::Values("regular", "random", "thin", "nearly_straight",
                                                          "vertex_on_edge", "concave"),
                                          testing::Values(0, 1e3, 1e6)),
                         name_of);

TEST_P(PatchTestOfAll, HoldsToRoundOffWithTheCorrection) {
  int n_elements = 0;
  for_each(GradientCorrection::on,
           [&](const Rule& rule, const Basis& basis, const Points& polygon, const TabulatedElement& element) {
             const Residuals residuals = patch_residuals(polygon, element);
             const double bound = round_off(basis, polygon);
             EXPECT_LT(residuals.area, bound);
             EXPECT_LT(residuals.stress, bound);
             EXPECT_LT(residuals.forces, bound);
             if (rule.full_rank) {
               EXPECT_EQ(residuals.zero_modes, 3);
             }
             ++n_elements;
           });
  EXPECT_GT(n_elements, 100);
}

TEST_P(PatchTestOfAll, HoldsWithoutTheCorrectionButForTheForces) {
  for_each(GradientCorrection::off,
           [&](const Rule&, const Basis& basis, const Points& polygon, const TabulatedElement& element) {
             const Residuals residuals = patch_residuals(polygon, element);
             EXPECT_LT(residuals.area, round_off(basis, polygon));
             EXPECT_LT(residuals.stress, round_off(basis, polygon));
           });
}

}  // namespace
