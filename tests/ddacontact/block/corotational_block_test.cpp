#include <ddacontact/block/block_system.hpp>
#include <ddacontact/block/corotational_block.hpp>
#include <ddacontact/block/corotational_motion.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/quadrature/triangle_rule.hpp>
#include <tests/support/block_tangent.hpp>
#include <tests/support/random_polygon.hpp>
#include <tests/support/shape_motions.hpp>

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>

using namespace ddacontact;
using support::uniform;

namespace {

enum class Kind { wachspress, affine, affine_by_vertices };

/// Soft, for strains of some percent at moderate speeds.
BlockMaterial rubber() {
  return {polyfem::elasticity_matrix(1e6, 0.2, polyfem::Plane::strain), 1500};
}

std::shared_ptr<const CorotationalShape> make_shape(Kind kind, const Points& outline) {
  const std::vector<bool> none(outline.cols(), false);
  const Integration integration{&polyfem::hammer_rule(3), polyfem::GradientCorrection::on};
  return std::make_shared<const CorotationalShape>(
      kind == Kind::wachspress ? polygon_shape(rubber(), outline, polyfem::wachspress, integration)
      : kind == Kind::affine   ? affine_shape(rubber(), outline)
                             : affine_shape(rubber(), outline, choose_control_vertices(outline, none, none)));
}

Mat2 turn(double angle) {
  return Eigen::Rotation2Dd(angle).toRotationMatrix();
}

/// A free block without loads, stepped by itself.
struct OneBlock {
  std::shared_ptr<const CorotationalShape> shape;
  BlockSystem system;
  BlockState state;
  std::unique_ptr<BlockStep> begun;
  VectorXd d;  ///< of the last step

  OneBlock(Kind kind, const Points& outline)
      : shape(make_shape(kind, outline)), system(blocks_of(outline, shape)) {
    state = system.initial_state();
  }
  OneBlock(const OneBlock& other)
      : shape(other.shape), system(blocks_of(other.system.reference(), shape)), state(other.state) {}
  const Block& block() const { return system.block(0); }
  Index n() const { return system.n_unknowns(); }

  void displace(const VectorXd& by) {
    for (int v = 0; v < block().n_vertices(); ++v) state.position.col(v) += block().vertex_map(v)(by);
  }
  /// Turns the block about its origin.
  void rotate(double angle) { state.position = (turn(angle) * state.position).eval(); }
  /// Turned, strained by some percent, under initial stress, flying, spinning and vibrating.
  void excite(double angular_velocity) {
    rotate(0.7);
    displace(0.01 * VectorXd::Random(n()));
    state.stress.setConstant(3e3);
    state.velocity = block().rigid_modes(state) * Vec3(3, -2, angular_velocity) + 0.3 * VectorXd::Random(n());
    state.carried = VectorXd::Random(n());
  }
  void begin(const StepRule& rule, double dt) {
    if (!rule.has_half_steps())
      state.coordinates.resize(0);
    else if (state.coordinates.size() == 0)
      system.find_coordinates(state);
    block().begin_step(state, {rule, dt, state.going_on(), state.carried}, begun);
  }
  VectorXd resistance(const VectorXd& at) const {
    BlockForces f;
    begun->forces(at, f);
    return f.elastic() + f.inertia() + f.damping();
  }
  void step(const StepRule& rule, double dt, bool is_free = true) {
    begin(rule, dt);
    d = dt * state.going_on();
    MatrixXd A;
    VectorXd correction;
    int iterations = 0;
    do {  // down to round-off: the tangent leaves out terms of the order of the strain
      A = support::tangent_of(block(), *begun, d);
      correction = A.ldlt().solve(resistance(d));
      d -= correction;
    } while (correction.norm() > 1e-15 * (1 + d.norm()) && ++iterations < 300);
    BlockState next = state;
    begun->end(d, VectorXd::Zero(n()), is_free, next);
    state = next;
    state.carried_dt = rule.has_half_steps() ? dt : 0;
  }
  /// Linear momentum, and angular momentum about the centroid.
  Vec3 momentum() const { return block().rigid_modes(state).transpose() * block().mass() * state.going_on(); }
  double inertia() const {
    const VectorXd spin = block().rotation(state);
    return spin.dot(block().mass() * spin);
  }
  double kinetic() const { return state.going_on().dot(block().mass() * state.going_on()) / 2; }
  double energy() const { return kinetic() + block().elastic_energy(state); }
  /// Of its motions: what deformation has of momenta by its own rate is left out.
  double energy_of_motions() const {
    const MotionShape& motions = shape->motions();
    const Points velocities = NodalKinematics<polyfem::AnyNodes>(*shape).to_nodes(state.going_on());
    const VectorXd s = support::velocities_of(motions, state.coordinates, velocities);
    const MatrixXd& M = shape->cells[0].mass;
    const Points Z = support::deformed(motions, state.coordinates),
                 rates = s.tail(2 * motions.n_nodes()).reshaped(2, motions.n_nodes());
    return motions.mass * s.head<2>().squaredNorm() / 2 + (Z * M).cwiseProduct(Z).sum() * s[2] * s[2] / 2 +
           (rates * M).cwiseProduct(rates).sum() / 2 + block().elastic_energy(state);
  }

 private:
  static std::vector<std::unique_ptr<Block>> blocks_of(
      const Points& outline, const std::shared_ptr<const CorotationalShape>& shape) {
    std::vector<std::unique_ptr<Block>> blocks;
    blocks.push_back(std::make_unique<CorotationalBlock>(rubber(), outline, shape));
    return blocks;
  }
};

constexpr Scheme all_schemes[] = {Scheme::decaying, Scheme::midpoint,       Scheme::dda,
                                  Scheme::newmark,  Scheme::backward_euler, Scheme::central_difference};

StepRule rule_of(Scheme scheme) {
  AnalysisOptions options;
  options.scheme = scheme;
  return step_rule(options, 1, 1);
}

class CorotationalBlocks : public testing::TestWithParam<Kind> {
 protected:
  std::mt19937 random{41};

  template <class Check>
  void for_each_block(const Check& check) {
    for (int n = 3; n <= 7; ++n) {
      SCOPED_TRACE(testing::Message() << n << " vertices");
      const Points outline = support::random_convex_polygon(n, random).colwise() + Vec2(40, -30);
      check(OneBlock(GetParam(), outline));
    }
  }
};

INSTANTIATE_TEST_SUITE_P(, CorotationalBlocks,
                         testing::Values(Kind::wachspress, Kind::affine, Kind::affine_by_vertices),
                         [](const auto& p) -> std::string {
                           return p.param == Kind::wachspress ? "wachspress"
                                  : p.param == Kind::affine   ? "affine"
                                                              : "affine_by_vertices";
                         });

}  // namespace

TEST_P(CorotationalBlocks, RigidMotionsHaveTheMassInertiaAndWeightOfTheOutlineAtAnyRotation) {
  for_each_block([](OneBlock one) {
    for (double angle : {0., 1.1, 2.9}) {
      one.rotate(angle);
      const Block& block = one.block();
      const auto rigid = block.rigid_modes(one.state);
      const polyfem::AreaMoments moments = block.moments(one.state);
      const double mass = 1500 * moments.area, inertia = 1500 * moments.second.trace();
      const Mat3 expected = Vec3(mass, mass, inertia).asDiagonal();
      EXPECT_LE((rigid.transpose() * block.mass() * rigid - expected).norm(), 1e-11 * mass);
      VectorXd F = VectorXd::Zero(one.n());
      block.add_body_force({3, -7}, F);
      EXPECT_LE((rigid.transpose() * F - moments.area * Vec3(3, -7, 0)).norm(), 1e-11);
      EXPECT_NEAR(block.integration_weights().sum(), block.reference_area(), 1e-12 * block.reference_area());
      for (int v = 0; v < block.n_vertices(); ++v) {
        const Vec2 r = one.state.position.col(v) - moments.centroid;
        EXPECT_LE((block.vertex_map(v)(rigid.col(0)) - Vec2::UnitX()).norm(), 1e-12);
        EXPECT_LE((block.vertex_map(v)(rigid.col(1)) - Vec2::UnitY()).norm(), 1e-12);
        EXPECT_LE((block.vertex_map(v)(rigid.col(2)) - Vec2(-r.y(), r.x())).norm(), 1e-12);
      }
    }
  });
}

TEST_P(CorotationalBlocks, VerticesEndWhereTheirMapsSay) {
  for_each_block([](OneBlock one) {
    one.excite(2);
    one.begin(rule_of(Scheme::decaying), 0.01);
    const VectorXd d = 0.05 * VectorXd::Random(one.n());
    BlockState next = one.state;
    one.begun->end(d, VectorXd::Zero(one.n()), false, next);
    const Points moved = one.system.positions(next) - one.system.positions(one.state);
    VectorXd displaced(one.n());
    one.begun->displacement(d, displaced);
    for (int v = 0; v < one.block().n_vertices(); ++v)
      EXPECT_LE((moved.col(v) - one.block().vertex_map(v)(displaced)).norm(), 1e-13);
  });
}

/// Also without the momentum that a free block is given: where the step's equations hold, they keep it.
TEST_P(CorotationalBlocks, AFreeStepKeepsItsMomenta) {
  for_each_block([](OneBlock one) {
    one.excite(5);
    for (Scheme scheme : all_schemes)
      for (bool is_free : {true, false}) {
        SCOPED_TRACE(testing::Message() << "scheme " << static_cast<int>(scheme) << ", free " << is_free);
        OneBlock after(one);
        // Newmark carries the acceleration on: that of the block must be one that no force made.
        if (scheme == Scheme::newmark) after.state.carried.setZero();
        after.step(rule_of(scheme), 0.02, is_free);
        const Vec3 change = after.momentum() - one.momentum();
        EXPECT_LE(change.head<2>().norm(), 1e-13 * one.momentum().head<2>().norm());
        // The decaying scheme carries deformation on through a changing shape: that moment is left to
        // end_step.
        if (!rule_of(scheme).mean_forces() || (scheme == Scheme::decaying && !is_free)) continue;
        EXPECT_LE(std::abs(change[2]), 1e-12 * one.inertia() * 5);
      }
  });
}

TEST_P(CorotationalBlocks, TheTangentIsTheDerivativeOfTheForcesOfAnUnstrainedBlock) {
  for_each_block([](OneBlock one) {
    one.rotate(2.2);
    for (Scheme scheme : all_schemes) {
      StepRule rule = rule_of(scheme);
      rule.damping = {3, 0.004};
      one.begin(rule, 0.01);
      MatrixXd A, differences(one.n(), one.n());
      A = support::tangent_of(one.block(), *one.begun, VectorXd::Zero(one.n()));
      for (Index k = 0; k < one.n(); ++k) {
        const VectorXd h = 1e-6 * VectorXd::Unit(one.n(), k);
        differences.col(k) = (one.resistance(h) - one.resistance(-h)) / 2e-6;
      }
      EXPECT_LE((differences - A).norm(), 1e-8 * A.norm()) << "scheme " << static_cast<int>(scheme);
      EXPECT_LE((A - A.transpose()).norm(), 1e-14 * A.norm());
      EXPECT_EQ(A.llt().info(), Eigen::Success);
    }
  });
}

TEST_P(CorotationalBlocks, EnergyStaysWithTheMidpointSchemeAndNeverGrowsWithTheDecayingOne) {
  for_each_block([](OneBlock one) {
    one.excite(5);
    OneBlock decaying(one);
    const double start = one.energy();
    for (int k = 0; k < 30; ++k) {
      one.step(rule_of(Scheme::midpoint), 0.01);
      EXPECT_NEAR(one.energy(), start, 1e-11 * start);
      decaying.begin(rule_of(Scheme::decaying), 0.01);
      const double before = decaying.energy_of_motions();
      decaying.step(rule_of(Scheme::decaying), 0.01);
      EXPECT_LE(decaying.energy_of_motions(), before + 1e-12 * start) << "step " << k;
    }
    EXPECT_LT(decaying.energy(), start * (1 - 1e-4));
  });
}

/// The shape that bears its centrifugal forces in its own frame, (K - w^2 M) u = w^2 M X with B(u) = 0, turns
/// by 2 atan(w dt / 2) a step and stays as it is.
TEST_P(CorotationalBlocks, ASteadySpinStaysSteadyInLargeSteps) {
  for_each_block([](OneBlock one) {
    constexpr double w = 5, dt = 0.1;
    const CorotationalShape& shape = *one.shape;
    const Index m = shape.nodes.cols();
    MatrixXd M = MatrixXd::Zero(2 * m, 2 * m);
    for (Index a = 0; a < m; ++a)
      for (Index b = 0; b < m; ++b)
        M.block<2, 2>(2 * a, 2 * b) = shape.cells[0].mass(a, b) * Mat2::Identity();
    const VectorXd X = shape.nodes.reshaped();
    const Points weights = GetParam() == Kind::wachspress
                               ? polyfem::mean_gradient_weights(shape.nodes)
                               : Points(shape.nodes / one.block().reference_area());
    VectorXd beta(2 * m);  // B(z) = beta . z
    for (Index a = 0; a < m; ++a) beta.segment<2>(2 * a) << -weights(1, a), weights(0, a);
    MatrixXd bordered = MatrixXd::Zero(2 * m + 1, 2 * m + 1);
    bordered << shape.cells[0].elastic.stiffness() - w * w * M, beta, beta.transpose(), 0;
    VectorXd centrifugal = VectorXd::Zero(2 * m + 1);
    centrifugal.head(2 * m) = w * w * (M * X);
    const VectorXd u = bordered.partialPivLu().solve(centrifugal).head(2 * m);
    ASSERT_GT(u.norm(), 1e-3 * X.norm());
    Points stretched = (X + u).reshaped(2, m);
    if (shape.points.size() > 0) stretched = (stretched * shape.points.transpose()).eval();
    for (Scheme scheme : {Scheme::midpoint, Scheme::decaying}) {
      if (scheme == Scheme::decaying) {  // in the frame of the motions: J X M u = 0 in place of B(u) = 0
        MatrixXd by_momenta = bordered;
        by_momenta.bottomLeftCorner(1, 2 * m) = shape.motions().turning.reshaped().transpose();
        by_momenta.topRightCorner(2 * m, 1) = shape.motions().turning.reshaped();
        const VectorXd in_frame = by_momenta.partialPivLu().solve(centrifugal).head(2 * m);
        stretched = (X + in_frame).reshaped(2, m);
        if (shape.points.size() > 0) stretched = (stretched * shape.points.transpose()).eval();
      }
      OneBlock spinning(one);
      spinning.state.position = stretched;
      spinning.state.velocity = w * spinning.block().rotation(spinning.state);
      for (int k = 1; k <= 12; ++k) {
        spinning.step(rule_of(scheme), dt);
        const double angle = scheme == Scheme::midpoint ? 2 * std::atan(w * dt / 2) : w * dt;
        const Points expected = turn(k * angle) * stretched;
        EXPECT_LE((spinning.state.position - expected).norm(), 1e-10) << "step " << k;
        EXPECT_LE((spinning.state.going_on() - w * spinning.block().rotation(spinning.state)).norm(), 1e-9);
      }
    }
  });
}

TEST_P(CorotationalBlocks, StressTurnsWithTheBlock) {
  for_each_block([](OneBlock one) {
    one.excite(0);
    const Tensors before = one.block().stress(one.state);
    const double energy = one.block().elastic_energy(one.state);
    const Mat2 R = turn(2.5);
    one.rotate(2.5);
    const Tensors after = one.block().stress(one.state);
    for (Index q = 0; q < before.cols(); ++q) {
      Mat2 a, b;
      a << before(0, q), before(2, q), before(2, q), before(1, q);
      b << after(0, q), after(2, q), after(2, q), after(1, q);
      EXPECT_LE((b - R * a * R.transpose()).norm(), 1e-12 * rubber().elasticity.norm());
    }
    EXPECT_NEAR(one.block().elastic_energy(one.state), energy, 1e-11 * energy);
  });
}
