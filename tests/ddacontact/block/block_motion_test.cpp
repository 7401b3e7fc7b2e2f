#include <ddacontact/block/block_motion.hpp>
#include <ddacontact/block/corotational_block.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/quadrature/triangle_rule.hpp>
#include <tests/support/shape_motions.hpp>

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

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

BlockMaterial rock(double young) {
  return {polyfem::elasticity_matrix(young, 0.25, polyfem::Plane::strain), 2500};
}

std::shared_ptr<const CorotationalShape> polygon(double young) {
  return std::make_shared<const CorotationalShape>(
      polygon_shape(rock(young), kite(), polyfem::suitable_basis(kite()),
                    {&polyfem::hammer_rule(3), polyfem::GradientCorrection::on}));
}

/// Steps without external forces, of lengths that are given.
struct Flight {
  std::shared_ptr<const CorotationalShape> owned;
  const CorotationalShape& shape = *owned;
  CorotationalBlock block;
  VectorXd coordinates, velocity;
  double previous = 0;
  Scheme scheme = Scheme::decaying;
  RayleighDamping damping{};

  /// \param[in] stretch  the deformation at the start; that of the first node, others so that it has no
  /// momenta
  Flight(double young, const VectorXd& rates, double stretch = 0)
      : owned(polygon(young)), block(rock(young), kite(), owned) {
    block.number(0, 0, 0, 0, 0);
    const MotionShape& motions = shape.motions();
    Points y = motions.nodes;
    y(0, 0) += stretch;
    coordinates = motions.coordinates_of(y);
    coordinates.head<3>().setZero();
    velocity = support::node_velocities(motions, coordinates, rates).reshaped();
  }

  void step(double length) {
    StepRule rule{.scheme = scheme, .damping = damping};
    rule.impulse_time = (length + previous) / (2 * length);
    BlockMotion motion(block, shape);
    motion.begin(rule, length, coordinates, velocity, VectorXd());
    // The forces are affine in d: d solves forces(d) = 0.
    const Index n = shape.n_unknowns();
    const auto resisting = [&](const VectorXd& at) -> VectorXd {
      BlockForces forces;
      motion.forces(at, forces);
      return forces.inertia();
    };
    const VectorXd at_zero = resisting(VectorXd::Zero(n));
    MatrixXd A(n, n);
    for (Index k = 0; k < n; ++k) A.col(k) = resisting(VectorXd::Unit(n, k)) - at_zero;
    EXPECT_LE((A - A.transpose()).norm(), 1e-9 * A.norm());
    const VectorXd d = -A.ldlt().solve(at_zero);
    lost = motion.losses(d);
    stored = motion.stored_energy(d);
    resultant = motion.resultant(d);
    BlockState next;
    next.origin = Points::Zero(2, 1);
    next.position = Points::Zero(2, 4);
    next.coordinates = coordinates;
    next.carried = velocity;
    motion.end(d, VectorXd(), false, next);
    coordinates = next.coordinates;
    velocity = next.carried;
    previous = length;
  }
  VectorXd rates() const {
    return support::velocities_of(shape.motions(), coordinates, velocity.reshaped(2, 4));
  }
  double angular_momentum() const {
    const Points Z = support::deformed(shape.motions(), coordinates);
    return (Z * shape.cells[0].mass).cwiseProduct(Z).sum() * rates()[2];
  }
  VectorXd deformation() const { return coordinates.tail(8); }

  BlockMotion::Losses lost{};
  double stored = 0;
  Vec3 resultant = Vec3::Zero();
};

MatrixXd mass_of(const CorotationalShape& shape) {
  MatrixXd M = MatrixXd::Zero(8, 8);
  for (Index a = 0; a < 4; ++a)
    for (Index b = 0; b < 4; ++b) M.block<2, 2>(2 * a, 2 * b) = shape.cells[0].mass(a, b) * Mat2::Identity();
  return M;
}

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
  for (int k = 0; k < 200; ++k) {
    flight.step(k % 3 == 0 ? dt : dt / 4);
    EXPECT_LE(flight.resultant.norm(), 1e-9 * before / dt) << "no force changes them";
  }
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
  const MatrixXd M = mass_of(flight.shape);
  VectorXd u = flight.deformation(), rate = VectorXd::Zero(8);
  for (int k = 0; k < 5; ++k) {
    const double h = k == 0 ? dt / 2 : dt;
    rate = (M + h * dt * K).ldlt().solve(M * rate - h * K * u);
    u += dt * rate;
    flight.step(dt);
    EXPECT_LE((flight.deformation() - u).norm(), 1e-10 * u.norm()) << k;
  }
}

/// A mode of frequency w has u_n = u_0 cos(n angle) with sin(angle / 2) = w dt / 2.
TEST(BlockMotion, CentralDifferencesVibrateAtTheirOwnFrequency) {
  Flight flight(1e8, at_rest());
  flight.scheme = Scheme::central_difference;
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> modes(flight.shape.cells[0].elastic.stiffness(),
                                                                 mass_of(flight.shape));
  for (Index k = 3; k < 8; ++k) {
    const double w = std::sqrt(modes.eigenvalues()[k]), step = 1.2 / flight.shape.highest_frequency(),
                 angle = 2 * std::asin(w * step / 2);
    const VectorXd mode = 1e-6 * modes.eigenvectors().col(k).normalized();
    flight.coordinates << at_rest().head<3>(), mode;
    flight.velocity.setZero();
    flight.previous = 0;
    for (int n = 1; n <= 100; ++n) {
      flight.step(step);
      EXPECT_LE((flight.deformation() - std::cos(n * angle) * mode).norm(), 1e-5 * mode.norm());
    }
  }
}

TEST(BlockMotion, CentralDifferencesAreStableToTheCriticalStep) {
  for (double stiffness : {0., 2e-4, 2e-2})
    for (double part : {0.99, 1.01}) {
      VectorXd rates = at_rest();
      rates.tail<8>() << 1, -2, 3, 1, -1, 2, -3, 1;
      Flight flight(1e8, 1e-4 * rates, 1e-6);
      flight.scheme = Scheme::central_difference;
      flight.damping.stiffness = stiffness;
      const double step = part * critical_step(flight.shape, flight.damping);
      double early = 0;
      bool grows = false;
      for (int n = 0; n < 1000 && !grows; ++n) {
        flight.step(step);
        const double now = flight.deformation().norm();
        if (n < 20) early = std::max(early, now);
        grows = now > 20 * early;
      }
      EXPECT_EQ(grows, part > 1) << stiffness;
    }
}

/// Without external forces what is stored, lost and left of inertia's work adds up to nothing: the change of
/// kinetic energy is taken off the scheme's part afterwards.
TEST(BlockMotion, LossesAddUp) {
  for (Scheme scheme : {Scheme::decaying, Scheme::central_difference}) {
    Flight flight(1e8, spinning(5), 1e-2);
    flight.scheme = scheme;
    flight.damping = {3, 1e-5};
    for (int k = 0; k < 20; ++k) {
      flight.step(1e-4);
      const double sum = flight.stored + flight.lost.damping + flight.lost.scheme;
      EXPECT_LE(std::abs(sum), 1e-9 * (std::abs(flight.stored) + std::abs(flight.lost.scheme))) << k;
    }
  }
}

TEST(BlockMotion, AStraightMotionTurnsOnItsWay) {
  const auto shape = polygon(1e10);
  const CorotationalBlock block(rock(1e10), kite(), shape);
  StepRule rule;
  rule.scheme = Scheme::decaying;
  const MotionShape& motions = shape->motions();
  BlockMotion motion(block, *shape);
  motion.begin(rule, dt, at_rest(), support::node_velocities(motions, at_rest(), spinning(100)).reshaped(),
               VectorXd());
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
