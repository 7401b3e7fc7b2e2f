#include <ddacontact/block/block_motion.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/quadrature/triangle_rule.hpp>

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include <cmath>

using namespace ddacontact;

namespace {

constexpr double dt = 1e-3;

Points kite() {
  Points outline(2, 4);
  outline << 0, 1.4, 1, -0.2,  //
      0, 0.1, 1.2, 0.9;
  return outline;
}

CorotationalShape polygon(double young) {
  const BlockMaterial rock{polyfem::elasticity_matrix(young, 0.25, polyfem::Plane::strain), 2500};
  return polygon_shape(rock, kite(), polyfem::suitable_basis(kite()),
                       {&polyfem::hammer_rule(3), polyfem::GradientCorrection::on});
}

/// Steps without external forces, of lengths that are given.
struct Flight {
  CorotationalShape shape;
  VectorXd coordinates, velocity;
  double previous = 0;

  /// \param[in] stretch  the deformation at the start; that of the first node, others so that it has no
  /// momenta
  Flight(double young, const VectorXd& rates, double stretch = 0) : shape(polygon(young)) {
    const MotionShape& motions = shape.motions();
    Points y = motions.nodes;
    y(0, 0) += stretch;
    coordinates = motions.coordinates_of(y);
    coordinates.head<3>().setZero();
    velocity = motions.node_velocities(coordinates, rates).reshaped();
  }

  void step(double length) {
    StepRule rule;
    rule.scheme = Scheme::decaying;
    rule.impulse_time = (length + previous) / (2 * length);
    CorotationalStart start{step_matrices(shape, rule, length), {}};
    BlockMotion::begin(shape, coordinates, velocity, VectorXd(), start);
    const BlockMotion motion(shape, start);
    // The forces are affine in d: d solves forces(d) = 0.
    const Index n = shape.n_unknowns();
    VectorXd at_zero(n), column(n);
    motion.forces(VectorXd::Zero(n), at_zero);
    MatrixXd A(n, n);
    for (Index k = 0; k < n; ++k) {
      motion.forces(VectorXd::Unit(n, k), column);
      A.col(k) = column - at_zero;
    }
    EXPECT_LE((A - A.transpose()).norm(), 1e-9 * A.norm());
    Points places(2, 4);
    const VectorXd d = -A.ldlt().solve(at_zero);
    motion.end(d, VectorXd(), coordinates, places, velocity);
    previous = length;
  }
  VectorXd rates() const { return shape.motions().velocities_of(coordinates, velocity.reshaped(2, 4)); }
  double angular_momentum() const {
    const Points Z = shape.motions().deformed(coordinates);
    return (Z * shape.cells[0].mass).cwiseProduct(Z).sum() * rates()[2];
  }
  VectorXd deformation() const { return coordinates.tail(8); }
};

VectorXd at_rest() {
  return VectorXd::Zero(11);
}
VectorXd spinning(double omega) {
  VectorXd s = VectorXd::Zero(11);
  s.head<3>() << 3, -2, omega;
  return s;
}

}  // namespace

TEST(BlockMotion, ABlockInFlightKeepsItsMomenta) {
  Flight flight(1e8, spinning(5), 1e-2);
  const double before = flight.angular_momentum();
  for (int k = 0; k < 200; ++k) flight.step(k % 3 == 0 ? dt : dt / 4);
  EXPECT_NEAR(flight.rates()[0], 3, 1e-11);
  EXPECT_NEAR(flight.rates()[1], -2, 1e-11);
  EXPECT_NEAR(flight.angular_momentum(), before, 1e-11 * before);
}

TEST(BlockMotion, AStiffBlockTurnsByItsAngle) {
  const double turn = 2 * std::acos(-1.);
  Flight flight(1e12, spinning(turn));
  const int steps = 500;  // ten turns of 50 steps
  for (int k = 0; k < steps; ++k) flight.step(0.02);
  EXPECT_NEAR(flight.coordinates[2], 10 * turn, 1e-4);
}

/// (M + h dt K) u' = M u'_before - h K u, by dense matrices.
TEST(BlockMotion, DeformationFollowsByBackwardEuler) {
  Flight flight(1e8, at_rest(), 1e-2);
  const MatrixXd& K = flight.shape.cells[0].elastic.stiffness();
  MatrixXd M = MatrixXd::Zero(8, 8);
  for (Index a = 0; a < 4; ++a)
    for (Index b = 0; b < 4; ++b)
      M.block<2, 2>(2 * a, 2 * b) = flight.shape.cells[0].mass(a, b) * Mat2::Identity();
  VectorXd u = flight.deformation(), rate = VectorXd::Zero(8);
  for (int k = 0; k < 5; ++k) {
    const double h = k == 0 ? dt / 2 : dt;
    rate = (M + h * dt * K).ldlt().solve(M * rate - h * K * u);
    u += dt * rate;
    flight.step(dt);
    EXPECT_LE((flight.deformation() - u).norm(), 1e-10 * u.norm()) << k;
  }
}

TEST(BlockMotion, AStraightMotionTurnsOnItsWay) {
  const CorotationalShape shape = polygon(1e10);
  StepRule rule;
  rule.scheme = Scheme::decaying;
  const MotionShape& motions = shape.motions();
  CorotationalStart begun{step_matrices(shape, rule, dt), {}};
  BlockMotion::begin(shape, at_rest(), motions.node_velocities(at_rest(), spinning(100)).reshaped(),
                     VectorXd(), begun);
  const BlockMotion motion(shape, begun);
  VectorXd straight(8), displaced(8);
  motion.free_path(straight);
  motion.displacement(straight, displaced);
  const Points start = motions.nodes, end = start + displaced.reshaped(2, 4);
  for (int a = 0; a < 4; ++a) {
    const int b = (a + 1) % 4;
    EXPECT_NEAR((end.col(a) - end.col(b)).norm(), (start.col(a) - start.col(b)).norm(), 1e-12)
        << "no stretch";
  }
  EXPECT_GT((straight - displaced).norm(), 1e-3) << "the straight motion would stretch it";
}
