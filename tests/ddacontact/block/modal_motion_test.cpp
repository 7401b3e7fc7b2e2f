#include <ddacontact/block/modal_motion.hpp>
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

/// Steps without external forces, of lengths that are given: the straight motion is that of s_free.
struct Flight {
  CorotationalShape shape;
  VectorXd coordinates, velocity;
  double previous = 0;

  Flight(double young, const VectorXd& s, const VectorXd& rates)
      : shape(polygon(young)), coordinates(s), velocity(shape.modal().node_velocities(s, rates).reshaped()) {}

  void step(double length) {
    ModalMotion motion;
    StepRule rule;
    rule.scheme = Scheme::decaying;
    rule.impulse_time = (length + previous) / (2 * length);
    motion.begin(shape, rule, length, coordinates, velocity, VectorXd());
    // The forces are affine in d: d solves forces(d) = 0.
    const Index n = shape.n_unknowns();
    VectorXd at_zero(n), column(n), resisting(n);
    motion.forces(VectorXd::Zero(n), at_zero);
    MatrixXd A(n, n);
    for (Index k = 0; k < n; ++k) {
      motion.forces(VectorXd::Unit(n, k), column);
      A.col(k) = column - at_zero;
    }
    EXPECT_LE((A - A.transpose()).norm(), 1e-9 * A.norm());
    Points places(2, 4);
    motion.end(-A.ldlt().solve(at_zero), VectorXd(), coordinates, places, velocity);
    previous = length;
  }
  VectorXd rates() const {
    return shape.modal().velocities_of(coordinates, velocity.reshaped(2, shape.nodes.cols()));
  }
  double angular_momentum() const {
    return shape.modal().inertia(coordinates.tail(5)) * rates()[2];
  }
};

VectorXd at_rest() { return VectorXd::Zero(8); }
VectorXd spinning(double omega) {
  VectorXd s = VectorXd::Zero(8);
  s.head<3>() << 3, -2, omega;
  return s;
}

}  // namespace

TEST(ModalMotion, ABlockInFlightKeepsItsMomenta) {
  VectorXd start = at_rest();
  start.tail(5).setConstant(2e-3);
  Flight flight(1e8, start, spinning(5));
  const double before = flight.angular_momentum();
  for (int k = 0; k < 200; ++k) flight.step(k % 3 == 0 ? dt : dt / 4);
  EXPECT_NEAR(flight.rates()[0], 3, 1e-12);
  EXPECT_NEAR(flight.rates()[1], -2, 1e-12);
  EXPECT_NEAR(flight.angular_momentum(), before, 1e-11 * before);
}

TEST(ModalMotion, AStiffBlockTurnsByItsAngle) {
  const double omega = 2 * std::acos(-1.);
  Flight flight(1e12, at_rest(), spinning(omega));
  const int steps = 500;  // ten turns of 50 steps
  for (int k = 0; k < steps; ++k) flight.step(0.02);
  EXPECT_NEAR(flight.coordinates[2], 10 * 2 * std::acos(-1.), 1e-4);
}

TEST(ModalMotion, VibrationsDecayAsByBackwardEuler) {
  VectorXd start = at_rest();
  start[3] = 1e-2;
  Flight flight(1e8, start, VectorXd::Zero(8));
  const double w2 = flight.shape.modal().stiffness[0];
  flight.step(dt);
  double q = 1e-2, rate = 0, h = dt / 2;  // by hand: (1 + h dt w^2) q' = q'_before - h w^2 q
  rate = (rate - h * w2 * q) / (1 + h * dt * w2);
  q += dt * rate;
  EXPECT_NEAR(flight.coordinates[3], q, 1e-12);
  flight.step(dt);
  rate = (rate - dt * w2 * q) / (1 + dt * dt * w2);
  EXPECT_NEAR(flight.coordinates[3], q + dt * rate, 1e-12);
}

TEST(ModalMotion, AStraightMotionTurnsOnItsWay) {
  const CorotationalShape shape = polygon(1e10);
  ModalMotion motion;
  StepRule rule;
  rule.scheme = Scheme::decaying;
  motion.begin(shape, rule, dt, at_rest(),
               shape.modal().node_velocities(at_rest(), spinning(100)).reshaped(), VectorXd());
  VectorXd straight(8), displaced(8);
  motion.free_path(straight);
  motion.displacement(straight, displaced);
  const Points start = shape.modal().nodes, end = start + displaced.reshaped(2, 4);
  for (int a = 0; a < 4; ++a) {
    const int b = (a + 1) % 4;
    EXPECT_NEAR((end.col(a) - end.col(b)).norm(), (start.col(a) - start.col(b)).norm(), 1e-12) << "no stretch";
  }
  EXPECT_GT((straight - displaced).norm(), 1e-3) << "the straight motion would stretch it";
}
