#include <ddacontact/block/stress_projection.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/quadrature/triangle_rule.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

using namespace ddacontact;
using polyfem::GradientCorrection;

namespace {

struct ProjectedBlock {
  Points outline;
  polyfem::TabulatedElement element;
  Mat3 elasticity = polyfem::elasticity_matrix(3e9, 0.2, polyfem::Plane::strain);
  MatrixXd K;

  ProjectedBlock(const Points& polygon, GradientCorrection correction) : outline(polygon) {
    tabulate(outline, polyfem::hammer_rule(3), polyfem::wachspress, correction, element);
    polyfem::stiffness(element, elasticity, K);
  }
  Tensors strains(const Points& w, GradientCorrection correction) const {
    polyfem::TabulatedElement functions;
    tabulate(outline, polyfem::hammer_rule(3), polyfem::wachspress, correction, functions);
    Tensors strain;
    polyfem::strains(functions, w.reshaped(), strain);
    return strain;
  }
  Points project(const Tensors& stress) const {
    return stress_projection(element, K, outline, stress, polyfem::wachspress);
  }
};

}  // namespace

TEST(StressProjection, OfAUniformStressIsItsStrainWithoutMotion) {
  std::mt19937 random(9);
  for (const GradientCorrection correction : {GradientCorrection::off, GradientCorrection::on}) {
    const ProjectedBlock block(support::random_convex_polygon(6, random).colwise() + Vec2(30, -20),
                               correction);
    const Vec3 strain(1e-3, -2e-3, 5e-4);
    const Points w = block.project((block.elasticity * strain).replicate(1, block.element.n_points()));
    EXPECT_LE((block.strains(w, correction).colwise() - strain).norm(), 1e-11 * strain.norm());
    EXPECT_LE(w.rowwise().mean().norm(), 1e-11 * w.norm());
  }
}

/// What is left of any stress does no work in any strain of the element; the strains are those of the
/// functions' own gradients.
TEST(StressProjection, LeavesAStressThatHasNoForces) {
  std::mt19937 random(10);
  for (const GradientCorrection correction : {GradientCorrection::off, GradientCorrection::on}) {
    const ProjectedBlock block(support::random_convex_polygon(5, random), correction);
    const Tensors stress = Tensors::NullaryExpr(3, block.element.n_points(),
                                                [&] { return support::uniform(-1e6, 1e6, random); });
    const Tensors strain = block.strains(block.project(stress), GradientCorrection::off);
    VectorXd forces(10), left(10);
    polyfem::stress_forces(block.element, stress, forces);
    polyfem::stress_forces(block.element, stress - block.elasticity * strain, left);
    EXPECT_LE(left.norm(), 1e-10 * forces.norm());
  }
}
