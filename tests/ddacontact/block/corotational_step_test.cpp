/// \file Forces and ends of steps of shapes by their nodes: what energy, momentum and rigid motions demand.
#include <ddacontact/block/corotational_block.hpp>
#include <ddacontact/block/corotational_step.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/quadrature/triangle_rule.hpp>
#include <tests/ddacontact/simple_scenes.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

using namespace support;

namespace {

using Nodes = NodalKinematics<polyfem::AnyNodes>;

BlockMaterial rubber() {
  return {polyfem::elasticity_matrix(1e6, 0.2, polyfem::Plane::strain), 1500};
}

/// A polygon, a block of six unknowns or a mesh: 2 m x 1 m of 1 MPa and 1500 kg/m3.
CorotationalShape rubber_shape(int kind) {
  const Points outline = turned(rectangle(3, 1, 2, 1), 0.4);
  if (kind == 0)
    return polygon_shape(rubber(), outline, polyfem::suitable_basis(outline),
                         {&polyfem::hammer_rule(3), polyfem::GradientCorrection::on});
  if (kind == 1) return affine_shape(rubber(), outline);
  return mesh_shape(rubber(), divide(outline, {CellKind::voronoi, 6, 0, true}),
                    polyfem::GradientCorrection::on);
}

/// A step of such a shape from a turned and strained state with any velocities of its nodes.
class CorotationalSteps : public testing::TestWithParam<int> {
 protected:
  static constexpr double dt = 0.01, stress = 3e3;
  std::shared_ptr<const CorotationalShape> owned =
      std::make_shared<const CorotationalShape>(rubber_shape(GetParam()));
  const CorotationalShape& shape = *owned;
  CorotationalBlock block{rubber(), points_of(shape), owned};
  Nodes nodes{shape};
  std::mt19937 random{1};
  Points y0 = turned_by(0.7) * shape.nodes, velocity = any(1), acceleration = any(10);

  static Points points_of(const CorotationalShape& shape) {
    return shape.points.size() > 0 ? Points(shape.nodes * shape.points.transpose()) : shape.nodes;
  }
  Points any(double size) {
    Points motion(2, shape.nodes.cols());
    for (Index k = 0; k < motion.size(); ++k) motion.reshaped()[k] = uniform(-size, size, random);
    VectorXd d(shape.n_unknowns());
    nodes.to_unknowns(motion, d);  // of control vertices no others are possible
    return nodes.to_nodes(d);
  }
  VectorXd unknowns(const Points& motion) const {
    VectorXd d(shape.n_unknowns());
    nodes.to_unknowns(motion, d);
    return d;
  }
  CorotationalStep<polyfem::AnyNodes> begin(const StepRule& rule, double initial_stress = 0) {
    CorotationalStep<polyfem::AnyNodes> step(block, shape);
    step.begin(rule, dt, y0, velocity, acceleration,
               Tensors::Constant(3, shape.integration_weights.size(), initial_stress));
    return step;
  }
  static StepRule rule_of(Scheme scheme) { return {.scheme = scheme, .damping = {}}; }
  static StepRule newmark() { return {.scheme = Scheme::newmark, .beta = 0.3, .gamma = 0.6, .damping = {}}; }
  Points rigid(double angle, const Vec2& shift) const {
    return turn_less_one(angle) * nodes.arms(y0) + nodes.everywhere(shift);
  }
  static VectorXd elastic(const CorotationalStep<polyfem::AnyNodes>& step, const VectorXd& d) {
    BlockForces forces;
    step.forces(d, forces);
    return forces.elastic();
  }
};

}  // namespace

TEST_P(CorotationalSteps, RigidMotionsMeetNoElasticForceAndStoreNothing) {
  for (const Scheme scheme : {Scheme::backward_euler, Scheme::midpoint}) {
    const auto step = begin(rule_of(scheme));
    for (const double angle : {0.1, -1.3, 2.8}) {
      const Points motion = rigid(angle, {4, -3});
      EXPECT_LE(elastic(step, unknowns(motion)).norm(), 1e-6) << "N, of a stiffness of 1e6 N/m";
      EXPECT_NEAR(step.stored_energy(unknowns(motion)), 0, 1e-8);
    }
  }
}

TEST_P(CorotationalSteps, ForcesAtTheEndAreTheDerivativeOfTheEnergy) {
  y0 += any(0.01);
  const auto step = begin(rule_of(Scheme::backward_euler), stress);
  const VectorXd d = unknowns(any(0.02)), f = elastic(step, d);
  const double h = 1e-6;
  for (int trial = 0; trial < 10; ++trial) {
    const VectorXd way = unknowns(any(1));
    const auto energy = [&](double t) { return step.stored_energy(d + t * way); };
    EXPECT_NEAR(f.dot(way), (energy(h) - energy(-h)) / (2 * h), 1e-6 * f.norm() * way.norm());
  }
}

/// What makes the midpoint scheme keep energy, however large the step.
TEST_P(CorotationalSteps, ForcesAtTheMiddleDoTheWorkOfTheEnergy) {
  y0 += any(0.01);
  const auto step = begin(rule_of(Scheme::midpoint), stress);
  for (const double angle : {0.0, 0.5}) {
    const Points motion = rigid(angle, {1, 2}) + any(0.02);
    const VectorXd d = unknowns(motion);
    EXPECT_NEAR(elastic(step, d).dot(d), step.stored_energy(d),
                1e-9 * step.stored_energy(unknowns(any(0.1))));
  }
}

/// About where the forces act: the end, or half way.
TEST_P(CorotationalSteps, ElasticForcesHaveNeitherSumNorMoment) {
  y0 += any(0.01);
  for (const Scheme scheme : {Scheme::backward_euler, Scheme::midpoint}) {
    const auto step = begin(rule_of(scheme), stress);
    const Points motion = rigid(0.3, {1, 2}) + any(0.02);
    const VectorXd f = elastic(step, unknowns(motion));
    const double part = scheme == Scheme::midpoint ? 0.5 : 1;
    for (const Vec2& way : {Vec2(1, 0), Vec2(0, 1)})
      EXPECT_NEAR(nodes.work(f, nodes.everywhere(way)), 0, 1e-10 * f.norm());
    EXPECT_NEAR(nodes.work(f, nodes.spin(y0 + part * motion)), 0, 1e-10 * f.norm());
  }
}

/// Unstrained the tangent is the derivative of all forces.
TEST_P(CorotationalSteps, TangentIsTheDerivativeOfTheForces) {
  StepRule rule = newmark();
  rule.damping = {.mass = 3, .stiffness = 0.02};
  const auto step = begin(rule);
  const VectorXd way = unknowns(any(1));
  const auto resistance = [&](double t) -> VectorXd {
    BlockForces f;
    step.forces(t * way, f);
    return f.elastic() + f.inertia() + f.damping();
  };
  std::vector<MatrixXd> parts(shape.cells.size());
  step.tangent(VectorXd::Zero(shape.n_unknowns()), parts);
  VectorXd by_tangent = VectorXd::Zero(shape.n_unknowns());
  for (std::size_t c = 0; c < parts.size(); ++c) {
    const std::vector<int>& u = shape.cells[c].unknowns;
    by_tangent(u) += parts[c] * way(u);
  }
  const double h = 1e-6;
  EXPECT_LE(((resistance(h) - resistance(-h)) / (2 * h) - by_tangent).norm(), 1e-6 * by_tangent.norm());
}

/// By the angle whose half has the tangent dt omega / 2: as the schemes turn a rigid body.
TEST_P(CorotationalSteps, FreePathsAreRigid) {
  const auto motion = nodes.rigid(y0, velocity);
  const auto step = begin(newmark());
  VectorXd path(shape.n_unknowns());
  step.free_path(path);
  const Points expected = rigid(2 * std::atan(dt * motion.angular / 2), dt * motion.linear);
  EXPECT_LE((nodes.to_nodes(path) - expected).norm(), 1e-13);
}

/// What is rigid in a change turns the block, and its strain with it; small changes are added.
TEST_P(CorotationalSteps, ChangesTurnTheBlockByWhatIsRigidInThem) {
  const auto step = begin(newmark());
  const Points before = y0 + any(0.01), way = any(0.01);
  const auto motion = nodes.rigid(before, way);
  const Points strain = way - nodes.everywhere(motion.linear) - motion.angular * motion.turning;
  const double angle = 0.8;
  const Vec2 shift(2, 1);
  VectorXd d = unknowns(before - y0);
  step.add_change(unknowns(angle * motion.turning + nodes.everywhere(shift) + strain), d);
  const Points expected =
      turned_by(angle) * (nodes.arms(before) + strain) + nodes.everywhere(nodes.mean(before) + shift);
  EXPECT_LE((y0 + nodes.to_nodes(d) - expected).norm(), 1e-12);
  VectorXd little = unknowns(before - y0);
  const VectorXd change = unknowns(any(1e-5));
  step.add_change(change, little);
  EXPECT_LE((little - unknowns(before - y0) - change).norm(), 1e-8);
}

/// Whatever the displacements: the momentum that the forces have given, damping of the mass taken off; of
/// forces at the middle the moment of momentum too.
TEST_P(CorotationalSteps, MomentaAreThoseOfTheForces) {
  StepRule damped = rule_of(Scheme::dda);
  damped.damping.mass = 3;
  for (const StepRule& rule : {rule_of(Scheme::dda), damped, newmark(), rule_of(Scheme::midpoint)}) {
    const auto step = begin(rule);
    const Points motion = any(0.01);
    VectorXd external = VectorXd::Random(shape.n_unknowns());
    auto end = step.end(motion);
    step.keep_momenta(motion, 1e4 * external, end);
    const auto sum = [&](const Points& way) {
      return nodes.work(1e4 * external, way) -
             rule.damping.mass / dt * nodes.weighted(motion).cwiseProduct(way).sum();
    };
    const Vec2 mean = Vec2(sum(nodes.everywhere({1, 0})), sum(nodes.everywhere({0, 1}))) / shape.mass_total;
    const Vec2 gained = rule.scheme == Scheme::newmark ? 0.6 * mean + 0.4 * nodes.mean(acceleration) : mean;
    EXPECT_LE((nodes.mean(end.velocity) - nodes.mean(velocity) - dt * gained).norm(), 1e-11);
    if (rule.scheme != Scheme::midpoint) continue;
    const auto before = nodes.rigid(y0, velocity), after = nodes.rigid(y0 + motion, end.velocity);
    EXPECT_NEAR(after.inertia * after.angular - before.inertia * before.angular,
                dt * sum(nodes.spin(y0 + motion / 2)), 1e-8);
  }
}

INSTANTIATE_TEST_SUITE_P(PolygonSixUnknownsMesh, CorotationalSteps, testing::Values(0, 1, 2));
