#include <ddacontact/block/corotational_shape.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/quadrature/triangle_rule.hpp>
#include <tests/support/shape_motions.hpp>

#include <gtest/gtest.h>
#include <cstdlib>
#include <limits>

using namespace ddacontact;

namespace {

BlockMaterial rock() {
  return {polyfem::elasticity_matrix(10e9, 0.25, polyfem::Plane::strain), 2500};
}

/// A pentagon without symmetry.
Points pentagon(double size = 1) {
  Points outline(2, 5);
  outline << 0, 2, 2.4, 1.1, -0.3,  //
      0, -0.2, 1, 1.9, 1.2;
  return size * outline;
}

std::vector<CorotationalShape> motion_shapes(double size = 1) {
  std::srand(1);  // of Eigen's random matrices: whatever tests ran before
  std::vector<CorotationalShape> all;
  all.push_back(polygon_shape(rock(), pentagon(size), polyfem::suitable_basis(pentagon(size)),
                              {&polyfem::hammer_rule(3), polyfem::GradientCorrection::on}));
  all.push_back(affine_shape(rock(), pentagon(size)));
  for (const bool edge_nodes : {true, false}) {
    const MeshOptions mesh{.kind = CellKind::voronoi, .cells = 12, .cell_size = 0, .edge_nodes = edge_nodes};
    all.push_back(mesh_shape(rock(), divide(pentagon(size), mesh), polyfem::GradientCorrection::on));
  }
  return all;
}

/// Any nodes near the shape, turned and moved.
Points some_nodes(const MotionShape& shape) {
  const Points strained = shape.nodes + 1e-3 * Points::Random(2, shape.n_nodes());
  return turned_by(2.2) * strained + Vec2(3, -7) * shape.translation.transpose();
}

}  // namespace

TEST(MotionShape, HasTheMassOfTheOutlineAboutItsCentre) {
  for (const CorotationalShape& shape : motion_shapes()) {
    const MotionShape& motions = shape.motions();
    const polyfem::AreaMoments moments = polyfem::area_moments(pentagon());
    EXPECT_NEAR(motions.mass, rock().density * moments.area, 1e-9 * motions.mass);
    EXPECT_LE((motions.nodes * motions.weights).norm(), 1e-14);
    EXPECT_NEAR(motions.rest_inertia, rock().density * moments.second.trace(), 1e-9 * motions.rest_inertia);
  }
}

TEST(MotionShape, DeformationsCarryNoMomentaAndNodesReadBack) {
  for (const CorotationalShape& shape : motion_shapes()) {
    const MotionShape& motions = shape.motions();
    const Points y = some_nodes(motions);
    const VectorXd s = motions.coordinates_of(y);
    const Points u = s.tail(2 * motions.n_nodes()).reshaped(2, motions.n_nodes());
    const double round_off = std::numeric_limits<double>::epsilon() * y.cwiseAbs().maxCoeff();
    EXPECT_LE((u * motions.weights).norm(), round_off);
    EXPECT_LE(std::abs(motions.turning.cwiseProduct(u).sum()), 1e-14 * motions.rest_inertia);
    const VectorXd zero = VectorXd::Zero(motions.n_coordinates());
    EXPECT_LE((motions.nodes + support::node_displacements(motions, zero, s) - y).norm(), 1e-13);

    const Points v = Points::Random(2, motions.n_nodes());
    const VectorXd rates = support::velocities_of(motions, s, v);
    EXPECT_LE((support::node_velocities(motions, s, rates) - v).norm(), 1e-13);
    const Points deforming = rates.tail(2 * motions.n_nodes()).reshaped(2, motions.n_nodes());
    EXPECT_LE((deforming * motions.weights).norm(), 1e-14);
    EXPECT_LE(std::abs(motions.turning.cwiseProduct(deforming).sum()), 1e-13 * motions.rest_inertia);
  }
}

TEST(MotionShape, VelocitiesAreTheRatesOfDisplacements) {
  for (const CorotationalShape& shape : motion_shapes()) {
    const MotionShape& motions = shape.motions();
    const VectorXd s = motions.coordinates_of(some_nodes(motions));
    const VectorXd rates = support::velocities_of(motions, s, Points::Random(2, motions.n_nodes()));
    const double dt = 1e-6;
    const Points by_difference = (support::node_displacements(motions, s, dt * rates) -
                                  support::node_displacements(motions, s, -dt * rates)) /
                                 (2 * dt);
    EXPECT_LE((support::node_velocities(motions, s, rates) - by_difference).norm(),
              1e-9 * by_difference.norm());
  }
}

TEST(MotionShape, TwoDisplacementsAreOneAfterTheOther) {
  for (const CorotationalShape& shape : motion_shapes()) {
    const MotionShape& motions = shape.motions();
    const VectorXd start = motions.coordinates_of(some_nodes(motions)),
                   by = 0.3 * VectorXd::Random(motions.n_coordinates()),
                   zero = VectorXd::Zero(motions.n_coordinates());
    const Points at_once = support::node_displacements(motions, zero, start + by),
                 in_two = support::node_displacements(motions, zero, start) +
                          support::node_displacements(motions, start, by);
    EXPECT_LE((at_once - in_two).norm(), 1e-13 * (1 + at_once.norm()));
  }
}

TEST(MotionShape, AShapeAtRestHasNoDeformationAtAllWhateverItsSize) {
  for (double size : {1e-3, 1., 1e3})
    for (const CorotationalShape& shape : motion_shapes(size)) {
      const MotionShape& motions = shape.motions();
      const Points y =
          turned_by(0.4) * motions.nodes + size * Vec2(0.5, -1) * motions.translation.transpose();
      const auto deformation = [&](const Points& at) {
        return motions.coordinates_of(at).tail(2 * motions.n_nodes()).eval();
      };
      EXPECT_TRUE(deformation(y).isZero(0)) << size;
      EXPECT_FALSE(deformation((1 + 1e-12) * y).isZero(0)) << "but round-off alone";
    }
}

TEST(MotionShape, TurnLessOneKeepsTheDigitsOfSmallAngles) {
  const double angle = 1e-9;
  EXPECT_NEAR(turn_less_one(angle)(0, 0), -angle * angle / 2, 1e-30);
  EXPECT_LE((turn_less_one(2.5) - (turned_by(2.5) - Mat2::Identity())).norm(), 1e-15);
}
