#include <ddacontact/block/block_system.hpp>
#include <ddacontact/block/corotational_block.hpp>
#include <ddacontact/block/corotational_step.hpp>
#include <polyfem/core/parallel.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <tests/support/allocations.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

using namespace ddacontact;

namespace {

BlockMaterial rock() {
  return {polyfem::elasticity_matrix(1e9, 0.2, polyfem::Plane::strain), 2500};
}

std::shared_ptr<const CorotationalShape> shape_of(const Points& outline) {
  return std::make_shared<const CorotationalShape>(polygon_shape(
      rock(), outline, polyfem::wachspress, choose_integration(outline, polyfem::GradientCorrection::on)));
}

/// Convex blocks of three to seven corners that fly, turn and vibrate; those of as many corners are
/// congruent.
struct FlyingBlocks {
  explicit FlyingBlocks(int n) : system(make_blocks(n)), state(system.initial_state()) {
    system.find_coordinates(state);
    std::srand(3);
    state.velocity = VectorXd::Random(system.n_unknowns());
    start = {step_rule({}, 1e-3, 1e-3), 1e-3, state.velocity, state.carried};
    parts.resize(n);
    steps.resize(n);
    next = state;
    step();
  }

  /// All that a step asks of its blocks.
  void step() {
    d.resize(system.n_unknowns());
    change.setConstant(system.n_unknowns(), 1e-5);
    double energy = 0;
    for (int b = 0; b < system.n_blocks(); ++b) {
      const Block& block = system.block(b);
      const Range& u = block.unknowns();
      block.begin_step(state, start, steps[b]);
      const BlockStep& step = *steps[b];
      step.free_path(d.segment(u.first, u.count));
      step.add_change(change.segment(u.first, u.count), d.segment(u.first, u.count));
      step.forces(d.segment(u.first, u.count), forces);
      parts[b].resize(1);
      step.tangent(d.segment(u.first, u.count), parts[b]);
      energy += step.stored_energy(d.segment(u.first, u.count)) +
                step.elastic_loss(d.segment(u.first, u.count), forces.elastic()) +
                block.kinetic_energy(state.velocity.segment(u.first, u.count)) + block.elastic_energy(state);
      step.end(d.segment(u.first, u.count), change.segment(u.first, u.count), true, next);
    }
    EXPECT_GT(energy, 0);
  }

  BlockSystem system;
  BlockState state, next;
  StepStart start;
  VectorXd d, change;
  BlockForces forces;
  std::vector<std::vector<MatrixXd>> parts;
  std::vector<std::unique_ptr<BlockStep>> steps;

 private:
  static std::vector<std::unique_ptr<Block>> make_blocks(int n) {
    std::mt19937 random{7};
    std::vector<Points> outlines;
    std::vector<std::shared_ptr<const CorotationalShape>> shapes;
    for (int corners = 3; corners <= 7; ++corners) {
      outlines.push_back(support::random_convex_polygon(corners, random));
      shapes.push_back(shape_of(outlines.back()));
    }
    std::vector<std::unique_ptr<Block>> blocks;
    for (int b = 0; b < n; ++b)
      blocks.push_back(std::make_unique<CorotationalBlock>(rock(), outlines[b % 5].colwise() + Vec2(3 * b, 0),
                                                           shapes[b % 5]));
    return blocks;
  }
};

long allocations_of_a_step(int n_blocks) {
  FlyingBlocks flying(n_blocks);
  const long before = support::n_allocations();
  flying.step();
  return support::n_allocations() - before;
}

}  // namespace

TEST(BlockWork, OfOneBlockMoreNeedsNoMemory) {
  if (support::n_allocations() < 0) GTEST_SKIP() << "allocations are not counted under a sanitizer";
  EXPECT_EQ(allocations_of_a_step(200), allocations_of_a_step(20));
}

TEST(BlockWork, DoesNotDependOnTheNumberOfThreads) {
  FlyingBlocks one(500);
  polyfem::set_threads(3);
  FlyingBlocks many(500);
  polyfem::set_threads(1);
  EXPECT_EQ(one.next.position, many.next.position);
  EXPECT_EQ(one.next.velocity, many.next.velocity);
}

TEST(BlockWork, OnArraysOfKnownSizeIsThatOnAny) {
  std::mt19937 random{11};
  for (int corners = 3; corners <= 7; ++corners) {
    SCOPED_TRACE(testing::Message() << corners << " corners");
    const Points outline = support::random_convex_polygon(corners, random);
    const auto shape = shape_of(outline);
    const Index n = shape->n_unknowns();
    const Points y = shape->nodes + 1e-3 * Points::Random(2, corners), v = Points::Random(2, corners);
    const VectorXd d = 1e-3 * VectorXd::Random(n);
    const StepRule rule = step_rule({}, 1e-3, 1e-3);
    const Tensors stress = Tensors::Constant(3, shape->integration_weights.size(), 1e4);
    const CorotationalBlock block(rock(), outline, shape);
    CorotationalStep<polyfem::AnyNodes> plain(block, *shape);
    plain.begin(rule, 1e-3, y, v, v, stress);
    BlockForces expected, forces;
    plain.forces(d, expected);
    const auto expect_same = [&]<class Of>(const NodalKinematics<Of>& of) {
      EXPECT_NE(Of::Vectors::MaxColsAtCompileTime, Eigen::Dynamic);
      CorotationalStep<Of> step(block, *shape);
      step.begin(rule, 1e-3, y, v, v, stress);
      step.forces(d, forces);
      EXPECT_LE((forces.elastic() - expected.elastic()).norm(), 1e-13 * expected.elastic().norm());
      EXPECT_LE((forces.inertia() - expected.inertia()).norm(), 1e-12 * expected.inertia().norm());
      const auto moved = of.to_nodes(d);
      EXPECT_NEAR(step.stored_energy(d), plain.stored_energy(d), 1e-13 * std::abs(plain.stored_energy(d)));
      EXPECT_LE((step.end(moved).velocity - plain.end(moved).velocity).norm(),
                1e-12 * plain.end(moved).velocity.norm());
    };
    with_nodes(*shape, expect_same);
  }
}

TEST(BlockWork, MatricesOfAStepAreOfItsRuleAndLengthAndSharedByCongruentBlocks) {
  std::mt19937 random{13};
  const auto shape = shape_of(support::random_convex_polygon(5, random));
  StepRule rule = step_rule({}, 1e-3, 1e-3);
  const auto first = step_matrices(*shape, rule, 1e-3);
  EXPECT_EQ(step_matrices(*shape, rule, 1e-3), first);
  const auto shorter = step_matrices(*shape, rule, 1e-4);
  EXPECT_GT(shorter->tangents[0].norm(), 2 * first->tangents[0].norm());
  rule.damping.mass = 1e6;
  EXPECT_GT(step_matrices(*shape, rule, 1e-4)->tangents[0].norm(), 2 * shorter->tangents[0].norm());
}
