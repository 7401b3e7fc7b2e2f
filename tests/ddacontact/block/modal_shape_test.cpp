#include <ddacontact/block/corotational_shape.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/quadrature/triangle_rule.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

using namespace ddacontact;
using support::uniform;

namespace {

BlockMaterial rock() {
  return {polyfem::elasticity_matrix(10e9, 0.25, polyfem::Plane::strain), 2500};
}

/// A bent pentagon without symmetry.
Points pentagon() {
  Points outline(2, 5);
  outline << 0, 2, 2.4, 1.1, -0.3,  //
      0, -0.2, 1, 1.9, 1.2;
  return outline;
}

CorotationalShape polygon() {
  return polygon_shape(rock(), pentagon(), polyfem::suitable_basis(pentagon()),
                       {&polyfem::hammer_rule(3), polyfem::GradientCorrection::on});
}
CorotationalShape mesh() {
  return mesh_shape(rock(), divide(pentagon(), {.kind = CellKind::voronoi, .cells = 12}),
                    polyfem::GradientCorrection::on);
}
CorotationalShape straight_mesh() {
  return mesh_shape(rock(), divide(pentagon(), {.kind = CellKind::voronoi, .cells = 12, .edge_nodes = false}),
                    polyfem::GradientCorrection::on);
}

std::vector<CorotationalShape> shapes() {
  std::vector<CorotationalShape> all;
  all.push_back(polygon());
  all.push_back(affine_shape(rock(), pentagon()));
  all.push_back(mesh());
  all.push_back(straight_mesh());
  return all;
}

Points left(const Points& of) {
  Points turned(2, of.cols());
  turned.row(0) = -of.row(1);
  turned.row(1) = of.row(0);
  return turned;
}

VectorXd some_coordinates(const ModalShape& modal) {
  VectorXd s = VectorXd::Random(modal.n_unknowns());
  s[2] = 2.2;
  s.tail(modal.n_deformations()) *= 1e-3 * std::sqrt(modal.mass);
  return s;
}

}  // namespace

TEST(ModalShape, DeformationsCarryNoMomentaAndAreOrthonormalInMass) {
  for (const CorotationalShape& shape : shapes()) {
    const ModalShape& modal = shape.modal();
    const Index k = modal.n_deformations(), m = modal.nodes.cols();
    ASSERT_EQ(modal.n_unknowns(), shape.n_unknowns());
    EXPECT_LE((modal.deformations.transpose() * modal.momenta_of - MatrixXd::Identity(k, k)).cwiseAbs().maxCoeff(),
              1e-12);
    for (Index j = 0; j < k; ++j) {
      const Points momentum = modal.momenta_of.col(j).reshaped(2, m);
      EXPECT_LE((momentum * modal.translation).norm(), 1e-10 * momentum.norm());
      EXPECT_LE(std::abs(left(modal.nodes).cwiseProduct(momentum).sum()), 1e-10 * momentum.norm());
    }
    EXPECT_NEAR(modal.mass, rock().density * polyfem::signed_area(pentagon()), 1e-9 * modal.mass);
  }
}

TEST(ModalShape, TheStiffnessesAreThoseOfTheShape) {
  const CorotationalShape shape = polygon();
  const ModalShape& modal = shape.modal();
  const MatrixXd K = modal.deformations.transpose() * shape.cells[0].elastic.stiffness() * modal.deformations;
  const MatrixXd diagonal = modal.stiffness.asDiagonal();
  EXPECT_LE((K - diagonal).cwiseAbs().maxCoeff(), 1e-10 * modal.stiffness.maxCoeff());
  EXPECT_GT(modal.stiffness.minCoeff(), 1e-6 * modal.stiffness.maxCoeff()) << "three motions are rigid and no more";
}

TEST(ModalShape, CoordinatesAndVelocitiesOfNodesReadBack) {
  for (const CorotationalShape& shape : shapes()) {
    const ModalShape& modal = shape.modal();
    const VectorXd s = some_coordinates(modal), rates = VectorXd::Random(modal.n_unknowns());
    const Points y = modal.nodes + modal.node_displacements(VectorXd::Zero(modal.n_unknowns()), s);
    EXPECT_LE((modal.coordinates_of(y) - s).cwiseAbs().maxCoeff(), 1e-12 * std::sqrt(modal.mass));
    EXPECT_LE((modal.velocities_of(s, modal.node_velocities(s, rates)) - rates).cwiseAbs().maxCoeff(),
              1e-11 * std::sqrt(modal.mass));
  }
}

TEST(ModalShape, VelocitiesAreTheRatesOfDisplacements) {
  for (const CorotationalShape& shape : shapes()) {
    const ModalShape& modal = shape.modal();
    const VectorXd s = some_coordinates(modal), rates = VectorXd::Random(modal.n_unknowns());
    const double dt = 1e-6;
    const Points by_difference =
        (modal.node_displacements(s, dt * rates) - modal.node_displacements(s, -dt * rates)) / (2 * dt);
    EXPECT_LE((modal.node_velocities(s, rates) - by_difference).norm(), 1e-9 * by_difference.norm());
  }
}

TEST(ModalShape, TwoDisplacementsAreOneAfterTheOther) {
  for (const CorotationalShape& shape : shapes()) {
    const ModalShape& modal = shape.modal();
    const VectorXd start = some_coordinates(modal), by = 0.3 * VectorXd::Random(modal.n_unknowns());
    const VectorXd zero = VectorXd::Zero(modal.n_unknowns());
    const Points at_once = modal.node_displacements(zero, start + by),
                 in_two = modal.node_displacements(zero, start) + modal.node_displacements(start, by);
    EXPECT_LE((at_once - in_two).norm(), 1e-13 * (1 + at_once.norm()));
  }
}

TEST(ModalShape, APlaceOfRestHasNoDeformationAtAll) {
  const CorotationalShape shape = polygon();
  const ModalShape& modal = shape.modal();
  const Points y = (turned_by(0.4) * modal.nodes).colwise() + Vec2(3, -1);
  EXPECT_TRUE(modal.coordinates_of(y).tail(modal.n_deformations()).isZero(0));
}
