#include <ddacontact/equations/quiet_face.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <gtest/gtest.h>

using namespace support;

namespace {

/// A block turned by an angle, with dashpots on its right side of 3 m.
struct Dashpots {
  BuiltScene built;
  QuietFace face{1, 1, Tensors::Zero(3, 2), {}};
  double angle;

  explicit Dashpots(double by, BlockModel model = BlockModel::wachspress)
      : built(build(scene(by, model))), angle(by) {}
  static Scene scene(double by, BlockModel model) {
    Scene scene = rock_scene(0.1, 1);
    scene.blocks = {block(rectangle(9, 9, 1, 1)), block(turned(rectangle(0, 0, 2, 3), by))};
    scene.blocks[1].model = model;
    return scene;
  }
  const BlockSystem& blocks() const { return built.stepper->blocks(); }
  /// Of all unknowns in a rigid motion of the block.
  VectorXd all(const Vec3& rigid) const {
    VectorXd v = VectorXd::Zero(blocks().n_unknowns());
    const Block& of = blocks().block(1);
    v.segment(of.unknowns().first, of.n_unknowns()) = of.rigid_modes(built.stepper->state()) * rigid;
    return v;
  }
  /// The force on the block.
  Vec2 force(const StepRule& rule, double time_step, const VectorXd& before, const VectorXd& d) const {
    StepQuietFace quiet(blocks(), face);
    quiet.begin(blocks(), built.stepper->state(), {rule, time_step, before, VectorXd()});
    VectorXd F = VectorXd::Zero(d.size());
    quiet.add_forces(d, F);
    const Block& of = blocks().block(1);
    return of.translations().transpose() * F.segment(of.unknowns().first, of.n_unknowns());
  }
};

StepRule by_scheme(Scheme scheme) {
  StepRule rule;
  rule.scheme = scheme;
  return rule;
}

}  // namespace

/// Density times the speed of pressure waves across the face and of shear waves along it, by its length.
TEST(QuietFace, DashpotsHaveTheImpedanceOfTheRock) {
  const double E = 1e8, nu = 0.25, M = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)), G = E / (2 * (1 + nu)),
               across = 3 * std::sqrt(2000 * M), along = 3 * std::sqrt(2000 * G), time_step = 0.01;
  for (const BlockModel model : {BlockModel::wachspress, BlockModel::affine})
    for (const double angle : {0., 0.6}) {
      const Dashpots of(angle, model);
      const Eigen::Rotation2Dd R(angle);
      const Vec2 v = R * Vec2(2, -5);
      const Vec2 force = of.force(by_scheme(Scheme::newmark), time_step, of.all({7, 7, 0}),
                                  time_step * of.all({v.x(), v.y(), 0}));
      EXPECT_LE((force - R * Vec2(-2 * across, 5 * along)).norm(), 1e-9 * across);
    }
}

/// With half steps half of the velocity is that before; a static step has none.
TEST(QuietFace, TakesTheVelocityAtWhichItsForcesAct) {
  const Dashpots of(0);
  const double time_step = 0.02;
  const VectorXd before = of.all({3, 0, 0}), d = time_step * of.all({1, 0, 0});
  const Vec2 whole = of.force(by_scheme(Scheme::newmark), time_step, before, d);
  EXPECT_LE((of.force(by_scheme(Scheme::decaying), time_step, before, d) - 2 * whole).norm(),
            1e-9 * whole.norm());
  StepRule at_rest = by_scheme(Scheme::decaying);
  at_rest.starts_at_rest = true;
  EXPECT_EQ(of.force(at_rest, time_step, before, d).norm(), 0);
}

TEST(QuietFace, TheTangentIsTheDerivativeOfTheForces) {
  for (const Scheme scheme : {Scheme::newmark, Scheme::decaying}) {
    const Dashpots of(0.4);
    StepQuietFace quiet(of.blocks(), of.face);
    quiet.begin(of.blocks(), of.built.stepper->state(),
                {by_scheme(scheme), 0.01, of.all({1, 2, 3}), VectorXd()});
    const std::vector<int>& u = quiet.unknowns();
    ASSERT_EQ(u.size(), 4u);  // the two vertices of the edge
    EXPECT_TRUE(std::ranges::is_sorted(u));
    const MatrixXd K = quiet.tangent();
    VectorXd start = VectorXd::Zero(of.blocks().n_unknowns());
    quiet.add_forces(VectorXd::Zero(start.size()), start);
    for (int k = 0; k < 4; ++k) {
      VectorXd F = VectorXd::Zero(start.size());
      quiet.add_forces(VectorXd::Unit(start.size(), u[static_cast<std::size_t>(k)]), F);
      EXPECT_LE((K.col(k) - (start - F)(u)).norm(), 1e-9 * K.norm());
      EXPECT_GT(K(k, k), 0);
    }
  }
}
