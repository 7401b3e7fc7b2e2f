#include <ddacontact/time/impulse_problem.hpp>
#include <tests/ddacontact/time/touching_blocks.hpp>

#include <gtest/gtest.h>

#include <limits>

using namespace support;

namespace {

/// A block of 2 m2 and 4000 kg that lies on a floor on both of its corners.
struct LandingBlock {
  TouchingBlocks of;
  RigidMotions motions;
  ImpulseProblem problem;

  explicit LandingBlock(double bound, ContactTerm::Normal normal = ContactTerm::Normal::unilateral)
      : of({floor_block, block(rectangle(0, 0, 2, 1))}),
        motions(of.blocks, of.state, std::array{0, 1}),
        problem(motions, terms(bound, normal)) {}
  std::vector<ContactTerm> terms(double bound, ContactTerm::Normal normal) const {
    std::vector<ContactTerm> terms;
    for (const ImpactContact& contact : of.contacts) {
      ContactTerm& term = terms.emplace_back();
      term.gap = motions.rate_form(contact.gap);
      term.slip = motions.rate_form(contact.slip);
      term.bound = bound;
      term.normal = normal;
    }
    return terms;
  }
  /// Of both contacts, when the block moves so.
  NormalAndShear rates(const Vec3& rigid) {
    of.set_velocity(1, rigid);
    return problem.change_of_rates(motions.coefficients(of.v));
  }
};

}  // namespace

TEST(ImpulseProblem, StopsABlockThatLandsFlat) {
  LandingBlock block(0);
  ASSERT_TRUE(block.problem.solve(block.rates({0, -3, 0}), 1e-12));
  const NormalAndShear impulses = block.problem.impulses();
  ASSERT_EQ(impulses.rows(), 2);
  EXPECT_NEAR(impulses(0, 0), 4000 * 3 / 2, 1e-6);
  EXPECT_NEAR(impulses(1, 0), 4000 * 3 / 2, 1e-6);
  EXPECT_EQ(impulses.col(1).norm(), 0);
  EXPECT_LE(block.problem.largest_rate(), 1e-12);
  VectorXd after = block.of.v;
  block.motions.add_motion(block.problem.change(impulses), after);
  EXPECT_LE(after.norm(), 1e-9);
}

TEST(ImpulseProblem, WhatSeparatesTakesNoImpulseUnlessItIsBound) {
  LandingBlock free(0), bound(0, ContactTerm::Normal::bilateral);
  ASSERT_TRUE(free.problem.solve(free.rates({0, 2, 0}), 1e-12));
  EXPECT_EQ(free.problem.impulses().col(0).norm(), 0);
  EXPECT_EQ(free.problem.largest_rate(), 0);
  ASSERT_TRUE(bound.problem.solve(bound.rates({0, 2, 0}), 1e-12));
  EXPECT_NEAR(bound.problem.impulses().col(0).sum(), -4000 * 2, 1e-6);
}

/// Stopped by both contacts where they bear that, else by their bounds.
TEST(ImpulseProblem, ShearStaysWithinItsBounds) {
  LandingBlock sticks(1e9), slides(1e9), bonded(std::numeric_limits<double>::infinity());
  ASSERT_TRUE(sticks.problem.solve(sticks.rates({1, -3, 0}), 1e-12));
  EXPECT_NEAR(std::abs(sticks.problem.impulses().col(1).sum()), 4000, 1e-6);
  slides.problem.set_bounds(Eigen::Vector2d(500, 500));
  ASSERT_TRUE(slides.problem.solve(slides.rates({1, -3, 0}), 1e-12));
  EXPECT_NEAR(std::abs(slides.problem.impulses().col(1).sum()), 1000, 1e-6);
  bonded.problem.set_bounds(Eigen::Vector2d(500, 500));  // of bonds they stay infinite
  ASSERT_TRUE(bonded.problem.solve(bonded.rates({1, -3, 0}), 1e-12));
  EXPECT_NEAR(std::abs(bonded.problem.impulses().col(1).sum()), 4000, 1e-6);
  VectorXd after = sticks.of.v;
  sticks.motions.add_motion(sticks.problem.change(sticks.problem.impulses()), after);
  EXPECT_LE(after.norm(), 1e-9);
}

/// Impulses work on rates as what they change works on motions.
TEST(ImpulseProblem, ChangesAreTheTransposeOfRates) {
  const LandingBlock block(0);
  NormalAndShear impulses(2, 2);
  impulses << 3, 2, -1, 5;
  const Vec3 w(0.5, -2, 4);
  const NormalAndShear rates = block.problem.change_of_rates(w);
  EXPECT_NEAR(block.problem.change(impulses).dot(w), impulses.cwiseProduct(rates).sum(), 1e-12);
}
