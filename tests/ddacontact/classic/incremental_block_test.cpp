#include <ddacontact/block/block_system.hpp>
#include <ddacontact/classic/affine_block.hpp>
#include <ddacontact/classic/vertex_block.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/quadrature/triangle_rule.hpp>
#include <tests/support/block_tangent.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>

using namespace ddacontact;
using support::uniform;

namespace {

enum class Model { vertex, vertex_uncorrected, affine, affine_by_vertices };

BlockMaterial rock() {
  return {polyfem::elasticity_matrix(7e6, 0.2, polyfem::Plane::strain), 1500};
}

std::unique_ptr<IncrementalBlock> make_block(Model model, const Points& outline) {
  using enum polyfem::GradientCorrection;
  switch (model) {
    case Model::vertex:
      return std::make_unique<VertexBlock>(rock(), outline, Integration{&polyfem::hammer_rule(3), on});
    case Model::vertex_uncorrected:
      return std::make_unique<VertexBlock>(rock(), outline, Integration{&polyfem::hammer_rule(3), off});
    case Model::affine:
      return std::make_unique<AffineBlock>(rock(), outline);
    case Model::affine_by_vertices: {
      const std::vector<bool> none(outline.cols(), false);
      return std::make_unique<AffineBlock>(rock(), outline, choose_control_vertices(outline, none, none));
    }
  }
  return nullptr;
}

/// A system of one block, behind another one so that its entries do not start at 0.
struct OneBlock {
  BlockSystem system;
  BlockState state;

  OneBlock(Model model, const Points& outline) : system(blocks_of(model, outline)) {
    state = system.initial_state();
    system.reshape(state, true);
  }
  const IncrementalBlock& block() const { return static_cast<const IncrementalBlock&>(system.block(1)); }
  /// From the block's origin.
  Points outline() const { return state.position.rightCols(block().n_vertices()); }
  /// Inflates the reference shapes about the model's origin.
  void inflate(double factor) {
    state.position = factor * system.reference();
    for (int b = 0; b < 2; ++b) {
      const Range& v = system.block(b).vertices();
      state.position.middleCols(v.first, v.count).colwise() -= state.origin.col(b);
    }
    system.reshape(state);
  }
  VectorXd part(const VectorXd& F) const { return F.segment(block().unknowns().first, block().n_unknowns()); }
  VectorXd whole(const VectorXd& d) const {
    VectorXd all = VectorXd::Zero(system.n_unknowns());
    all.segment(block().unknowns().first, block().n_unknowns()) = d;
    return all;
  }
  Vec3 resultant(const VectorXd& F) const { return block().rigid_modes(state).transpose() * part(F); }

  /// Unknowns of the affine displacement u = u0 + G (x - centroid).
  VectorXd affine_field(const Vec2& u0, const Mat2& G) const {
    const int n = block().n_vertices();
    MatrixXd maps(2 * n, block().n_unknowns());
    VectorXd u(2 * n);
    for (int v = 0; v < n; ++v) {
      u.segment<2>(2 * v) = u0 + G * (outline().col(v) - block().moments(state).centroid);
      for (int k = 0; k < block().n_unknowns(); ++k)
        maps.block<2, 1>(2 * v, k) = block().vertex_map(v)(whole(VectorXd::Unit(block().n_unknowns(), k)));
    }
    return whole(maps.colPivHouseholderQr().solve(u));
  }

 private:
  static Points first() { return support::regular_polygon(3); }
  static std::vector<std::unique_ptr<Block>> blocks_of(Model model, const Points& outline) {
    std::vector<std::unique_ptr<Block>> blocks;
    blocks.push_back(make_block(Model::vertex, first()));
    blocks.push_back(make_block(model, outline));
    return blocks;
  }
};

class BlockModels : public testing::TestWithParam<Model> {
 protected:
  std::mt19937 random{17};

  template <class Check>
  void for_each_block(const Check& check) {
    for (int n = 3; n <= 8; ++n)
      for (int trial = 0; trial < 4; ++trial) {
        SCOPED_TRACE(testing::Message() << n << " vertices, trial " << trial);
        const Points outline =
            (uniform(0.3, 3, random) * support::random_convex_polygon(n, random)).colwise() + Vec2(4, -3);
        check(OneBlock(GetParam(), outline));
      }
  }
};

std::string name_of(const testing::TestParamInfo<Model>& model) {
  return std::array{"vertex", "vertex_uncorrected", "affine"}[model.index];
}
INSTANTIATE_TEST_SUITE_P(All, BlockModels,
                         testing::Values(Model::vertex, Model::vertex_uncorrected, Model::affine), name_of);

}  // namespace

TEST_P(BlockModels, StiffnessAndMassAreSymmetricAndStiffnessHasJustTheRigidModesInItsKernel) {
  for_each_block([&](const OneBlock& one) {
    const MatrixXd K = one.block().stiffness(), M = one.block().mass();
    EXPECT_LE((K - K.transpose()).norm(), 1e-14 * K.norm());
    EXPECT_LE((M - M.transpose()).norm(), 1e-14 * M.norm());
    EXPECT_LE((K * one.block().rigid_modes(one.state)).norm(), 1e-11 * K.norm());
    const VectorXd k = Eigen::SelfAdjointEigenSolver<MatrixXd>(K).eigenvalues();
    EXPECT_GT(k[3], 1e-9 * k[k.size() - 1]);
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<MatrixXd>(M).eigenvalues()[0], 0);
  });
}

TEST_P(BlockModels, RigidModesMoveTheOutlineRigidly) {
  for_each_block([&](const OneBlock& one) {
    for (int v = 0; v < one.block().n_vertices(); ++v) {
      const Vec2 r = one.outline().col(v) - one.block().moments(one.state).centroid;
      const auto moved = [&](int mode) {
        return one.block().vertex_map(v)(one.whole(one.block().rigid_modes(one.state).col(mode)));
      };
      EXPECT_LE((moved(0) - Vec2::UnitX()).norm(), 1e-13);
      EXPECT_LE((moved(1) - Vec2::UnitY()).norm(), 1e-13);
      EXPECT_LE((moved(2) - Vec2(-r.y(), r.x())).norm(), 1e-13);
    }
  });
}

/// Also of a block that has inflated since the start: it makes no mass.
TEST_P(BlockModels, RigidMotionsHaveTheMomentumAndInertiaOfTheStartingMass) {
  for_each_block([&](OneBlock one) {
    for (double inflation : {1., 1.3}) {
      one.inflate(inflation);
      const auto rigid = one.block().rigid_modes(one.state);
      const double mass = one.block().mass_total();
      EXPECT_NEAR(mass,
                  1500 * polyfem::signed_area(one.system.reference().rightCols(one.block().n_vertices())),
                  1e-9 * mass);
      const double inertia =
          mass / one.block().moments(one.state).area * one.block().moments(one.state).second.trace();
      const Mat3 expected = Vec3(mass, mass, inertia).asDiagonal();
      EXPECT_LE((rigid.transpose() * one.block().mass() * rigid - expected).norm(), 1e-11 * (mass + inertia));
      EXPECT_NEAR(one.block().integration_weights().sum(), one.block().moments(one.state).area, 1e-12 * mass);
    }
  });
}

TEST_P(BlockModels, BodyForcesActInTheCentroidOnTheStartingVolume) {
  for_each_block([&](OneBlock one) {
    for (double inflation : {1., 1.3}) {
      one.inflate(inflation);
      VectorXd F = VectorXd::Zero(one.system.n_unknowns());
      one.block().add_body_force({3, -7}, F);
      const Vec3 expected = one.block().reference_area() * Vec3(3, -7, 0);
      EXPECT_LE((one.resultant(F) - expected).norm(), 1e-11 * expected.norm());
    }
  });
}

TEST_P(BlockModels, StressesOfLinearFieldsAreExactAndRotationsMakeNone) {
  for_each_block([&](const OneBlock& one) {
    const Mat2 G = 1e-3 * Mat2::Random();
    const VectorXd d = one.affine_field(Vec2::Random(), G);
    Tensors stress = Tensors::Ones(3, one.system.n_stress_points());
    one.block().add_stress(d, stress);
    const Vec3 expected = rock().elasticity * Vec3(G(0, 0), G(1, 1), G(0, 1) + G(1, 0)) + Vec3::Ones();
    const auto of_block = stress.middleCols(one.block().stress_points().first, one.block().n_stress_points());
    EXPECT_LE((of_block.colwise() - expected).colwise().norm().maxCoeff(), 1e-10 * expected.norm());
    EXPECT_EQ(stress.leftCols(one.block().stress_points().first),
              Tensors::Ones(3, one.block().stress_points().first));

    Mat2 spin;
    spin << 0, -1, 1, 0;
    stress.setZero();
    one.block().add_stress(one.affine_field(Vec2(1, 2), spin), stress);
    EXPECT_LE(stress.norm(), 1e-11 * rock().elasticity.norm());
  });
}

/// Stress forces of a block balance, do the work of the stresses, and of the stress that a displacement makes
/// are
/// - K d.
TEST_P(BlockModels, StressForcesBalanceAndAgreeWithTheStiffness) {
  for_each_block([&](OneBlock one) {
    one.state.stress = 1e5 * Tensors::Random(3, one.system.n_stress_points());
    VectorXd F = VectorXd::Zero(one.system.n_unknowns());
    one.block().add_stress_forces(one.state, F);
    EXPECT_LE(one.resultant(F).norm(), 1e-10 * F.norm());
    EXPECT_NEAR(one.part(F).norm(), F.norm(), 1e-12 * F.norm());

    const VectorXd d = one.whole(1e-3 * VectorXd::Random(one.block().n_unknowns()));
    one.state.stress.setZero();
    one.block().add_stress(d, one.state.stress);
    F.setZero();
    one.block().add_stress_forces(one.state, F);
    const VectorXd Kd = one.block().stiffness() * one.part(d);
    EXPECT_LE((one.part(F) + Kd).norm(), 1e-12 * one.block().stiffness().norm() * d.norm());
    EXPECT_NEAR(one.block().elastic_energy(one.state), one.part(d).dot(Kd) / 2,
                1e-10 * std::abs(one.part(d).dot(Kd)));
  });
}

TEST_P(BlockModels, LoadsHaveTheirResultantsAndMoments) {
  for_each_block([&](OneBlock one) {
    const Vec2 c = one.block().moments(one.state).centroid;
    const auto applied = [&] {
      VectorXd F = VectorXd::Zero(one.system.n_unknowns());
      one.system.add_loads(one.state, 0.5, F);
      return one.resultant(F);
    };
    const Vec2 x = support::random_point_in(one.outline(), random), force(3, -5);
    one.system.end_time = 1;
    one.system.point_loads = {{{1, one.block().point_weights(x + Vec2(one.state.origin.col(1)))},
                               {TimeFunction::Kind::ramp, 2 * force, {}}}};
    EXPECT_LE((applied() - Vec3(3, -5, cross(x - c, force))).norm(), 1e-11);

    // A pressure follows its edge as it is now, here of a block twice its size.
    one.system.point_loads.clear();
    one.state.position *= 2;
    one.system.reshape(one.state);
    for (int e = 0; e < one.block().n_vertices(); ++e) {
      const Vec2 j = one.outline().col(e), k = one.outline().col((e + 1) % one.block().n_vertices());
      const Vec2 inward(-(k - j).y(), (k - j).x());
      one.system.pressure_loads = {{1, e, {TimeFunction::Kind::constant, {10, 0}, {}}}};
      const Vec2 arm = (j + k) / 2 - one.block().moments(one.state).centroid;
      const Vec3 expected(10 * inward.x(), 10 * inward.y(), 10 * cross(arm, inward));
      EXPECT_LE((applied() - expected).norm(), 1e-11 * (1 + expected.norm()));
    }

    one.system.pressure_loads.clear();
    one.system.body_loads = {{1, {TimeFunction::Kind::constant, {1, 2}, {}}}};
    EXPECT_LE((applied() - one.block().reference_area() * Vec3(1, 2, 0)).norm(), 1e-11);
  });
}

TEST_P(BlockModels, AMaterialPointTravelsWithAffineMotions) {
  for_each_block([&](const OneBlock& one) {
    const Vec2 x = support::random_point_in(one.outline(), random);
    const MaterialPoint point =
        MaterialPoint{1, one.block().point_weights(x + Vec2(one.state.origin.col(1)))};
    EXPECT_LE((one.system.interpolate(point, one.state.position) - x).norm(), 1e-12);
    const Mat2 G = Mat2::Random();
    const Vec2 expected = Vec2(1, 2) + G * (x - one.block().moments(one.state).centroid);
    EXPECT_LE((one.system.displacement(point, one.affine_field({1, 2}, G)) - expected).norm(), 1e-11);
  });
}

/// Unknowns are conjugate to forces that `unknown_lengths` makes comparable: doubling all lengths doubles the
/// ratio of a moment to a force, and with it the length.
TEST_P(BlockModels, UnknownLengthsScaleWithTheBlockWhereUnknownsAreAnglesOrStrains) {
  const Points outline = support::random_convex_polygon(5, random);
  const OneBlock one(GetParam(), outline), twice(GetParam(), 2 * outline);
  const MatrixXd scaled = one.block().mass().cwiseQuotient(one.block().unknown_lengths() *
                                                           one.block().unknown_lengths().transpose());
  const MatrixXd scaled_twice = twice.block().mass().cwiseQuotient(
      twice.block().unknown_lengths() * twice.block().unknown_lengths().transpose());
  EXPECT_LE((4 * scaled - scaled_twice).norm(), 1e-12 * scaled_twice.norm());
}

/// Of a step by Newmark's scheme with damping, from a stress, a velocity and an acceleration.
TEST_P(BlockModels, ATangentIsTheDerivativeOfTheForcesOfAStep) {
  for_each_block([&](OneBlock one) {
    StepRule rule{Scheme::newmark, 0.25, 0.5, {.mass = 3, .stiffness = 0.02}};
    const int n = one.block().n_unknowns();
    one.state.stress = 1e4 * Tensors::Random(3, one.system.n_stress_points());
    const VectorXd v = one.whole(VectorXd::Random(n)), a = one.whole(VectorXd::Random(n));
    const double dt = 0.05;
    std::unique_ptr<BlockStep> step;
    one.block().begin_step(one.state, {rule, dt, v, a}, step);
    const VectorXd d = 1e-3 * VectorXd::Random(n), h = VectorXd::Random(n);
    const auto sum = [&](const VectorXd& at) -> VectorXd {
      BlockForces forces;
      step->forces(at, forces);
      return forces.elastic() + forces.inertia() + forces.damping();
    };
    const VectorXd change = support::tangent_of(one.block(), *step, d) * h;
    EXPECT_LE((sum(d + h) - sum(d) - change).norm(), 1e-9 * change.norm());
    BlockForces forces;
    step->forces(d, forces);
    const double stored = step->stored_energy(d + 1e-3 * h) - step->stored_energy(d - 1e-3 * h);
    EXPECT_NEAR(stored, 2e-3 * forces.elastic().dot(h), 1e-8 * forces.elastic().norm());
    VectorXd F = VectorXd::Zero(v.size());
    one.block().add_stress_forces(one.state, F);
    EXPECT_LE((sum(VectorXd::Zero(n)) - one.block().mass() * one.part(-a - 4 / dt * v) + one.part(F)).norm(),
              1e-9 * change.norm());
    // Inertia is mass times the acceleration at the end; the trapezoidal rule for the velocity.
    BlockState next = one.state;
    next.velocity = v;
    next.carried = a;
    step->end(d, VectorXd::Zero(n), true, next);
    EXPECT_LE((one.block().mass() * one.part(next.carried) - forces.inertia()).norm(),
              1e-9 * forces.inertia().norm());
    EXPECT_LE((next.velocity - v - dt / 2 * (a + next.carried)).norm(), 1e-12 * next.velocity.norm());
    EXPECT_LE((one.part(dt * v + dt * dt / 4 * (a + next.carried)) - d).norm(), 1e-12);
    VectorXd path(n);
    step->free_path(path);
    EXPECT_EQ(path, one.part(dt * v));
  });
}

// Three models of one triangle, and the two bases of the affine block, are one physics.

namespace {

/// P with d_of = P d_by for the unknowns of two blocks of the same affine fields.
MatrixXd change_of_basis(const OneBlock& of, const OneBlock& by) {
  const int n = by.block().n_vertices();
  MatrixXd maps_of(2 * n, 6), maps_by(2 * n, 6);
  for (int v = 0; v < n; ++v)
    for (int k = 0; k < 6; ++k) {
      maps_of.block<2, 1>(2 * v, k) = of.block().vertex_map(v)(of.whole(VectorXd::Unit(6, k)));
      maps_by.block<2, 1>(2 * v, k) = by.block().vertex_map(v)(by.whole(VectorXd::Unit(6, k)));
    }
  return maps_of.colPivHouseholderQr().solve(maps_by);
}

void expect_same_physics(OneBlock& of, OneBlock& by) {
  const MatrixXd P = change_of_basis(of, by);
  const auto same = [](const MatrixXd& a, const MatrixXd& b) { return (a - b).norm() <= 1e-11 * b.norm(); };
  EXPECT_TRUE(same(P.transpose() * of.block().stiffness() * P, by.block().stiffness()));
  EXPECT_TRUE(same(P.transpose() * of.block().mass() * P, by.block().mass()));
  EXPECT_TRUE(same(P * by.block().rigid_modes(by.state), of.block().rigid_modes(of.state)));
  const Vec3 stress(3, -1, 2);
  of.state.stress.colwise() = stress;
  by.state.stress.colwise() = stress;
  VectorXd F_of = VectorXd::Zero(of.system.n_unknowns()), F_by = VectorXd::Zero(by.system.n_unknowns());
  of.block().add_stress_forces(of.state, F_of);
  by.block().add_stress_forces(by.state, F_by);
  EXPECT_TRUE(same(P.transpose() * of.part(F_of), by.part(F_by)));
  of.block().add_body_force({1, -4}, F_of);
  by.block().add_body_force({1, -4}, F_by);
  EXPECT_TRUE(same(P.transpose() * of.part(F_of), by.part(F_by)));
  const VectorXd d = VectorXd::Random(6);
  Tensors made_of = Tensors::Zero(3, of.system.n_stress_points()),
          made_by = Tensors::Zero(3, by.system.n_stress_points());
  of.block().add_stress(of.whole(P * d), made_of);
  by.block().add_stress(by.whole(d), made_by);
  EXPECT_LE((made_of.rightCols<1>() - made_by.rightCols<1>()).norm(), 1e-11 * made_by.norm());
}

}  // namespace

TEST(AffineBlock, EqualsTheVertexBlockOfATriangle) {
  std::mt19937 random(23);
  for (int trial = 0; trial < 20; ++trial) {
    const Points outline = support::random_convex_polygon(3, random).colwise() + Vec2(2, 1);
    OneBlock vertex(Model::vertex, outline), affine(Model::affine, outline);
    expect_same_physics(vertex, affine);
  }
}

TEST(AffineBlock, IsTheSamePhysicsInEveryBasis) {
  std::mt19937 random(29);
  for (int trial = 0; trial < 40; ++trial) {
    const int n = 3 + trial % 6;
    const Points outline = support::random_convex_polygon(n, random).colwise() + Vec2(2, 1);
    OneBlock plain(Model::affine, outline), by_vertices(Model::affine_by_vertices, outline);
    expect_same_physics(plain, by_vertices);
  }
}
