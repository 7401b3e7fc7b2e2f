#include <ddacontact/contact/contact_positions.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <gtest/gtest.h>

using namespace support;

namespace {

/// A plate and a block of 2 m x 1 m on it, far from the model's origin; turned by `angle`.
BuiltScene block_on_a_plate(double angle, const Vec2& at = {1e6, -1e6}) {
  Scene scene = rock_scene(0.1, 1);
  scene.blocks = {block(rectangle(5e5, 5e5, 1, 1)),
                  block(turned(rectangle(0, -1, 6, 1), angle).colwise() + at),
                  block(turned(rectangle(1, 0, 2, 1), angle).colwise() + at)};
  return build(scene);
}

double gap_at_rest(const MovingVertexEdge& motion, Index n_unknowns) {
  return motion.gap_and_slip_at(VectorXd::Zero(n_unknowns), 0, Directions::of_end).gap;
}

}  // namespace

TEST(ContactPositions, AreThoseOfTheVertexAndTheEdgeFromTheEdgesBlock) {
  const BuiltScene built = block_on_a_plate(0);
  const BlockSystem& blocks = built.stepper->blocks();
  const BlockState& state = built.stepper->state();
  for (const int vertex : {0, 3}) {  // the last one is followed by the first
    const RoundedPositions at = positions_of(blocks, state, {2, vertex, 1, 3});
    EXPECT_LE((at.i - at.k - Vec2(1, vertex == 0 ? 1 : 2)).norm(), 1e-9);
    EXPECT_LE((at.j - at.k - Vec2(0, 1)).norm(), 1e-9) << "the plate's left side, downwards";
    EXPECT_LE((at.after_i - at.i - (vertex == 0 ? Vec2(2, 0) : Vec2(0, -1))).norm(), 1e-9);
    const Vec2 absolute = blocks.positions(state).col(blocks.block(1).vertices().first + 3);
    EXPECT_LE((at.j + state.origin.col(1) - absolute).norm(), 1e-9);
  }
}

TEST(ContactPositions, TheMotionIsThatOfTheThreeVertices) {
  const BuiltScene built = block_on_a_plate(0.3);
  const BlockSystem& blocks = built.stepper->blocks();
  const MovingVertexEdge motion = motion_of(blocks, built.stepper->state(), {2, 1, 1, 3});
  VectorXd d = VectorXd::LinSpaced(blocks.n_unknowns(), 0, 1);
  EXPECT_EQ(motion.moved(d).i, blocks.block(2).vertex_map(1)(d));
  EXPECT_EQ(motion.moved(d).j, blocks.block(1).vertex_map(3)(d));
  EXPECT_EQ(motion.moved(d).k, blocks.block(1).vertex_map(0)(d));
  EXPECT_FALSE(motion.rounding);
}

/// Forces act beside the vertex on that side of it which lies along the edge, inside the block.
TEST(ContactPositions, InsetsLieAlongTheFaceThatTouches) {
  for (const double angle : {0., 0.7, 3.}) {
    const BuiltScene built = block_on_a_plate(angle);
    for (const int vertex : {0, 1}) {
      const MovingVertexEdge motion =
          motion_of(built.stepper->blocks(), built.stepper->state(), {2, vertex, 1, 2}, 0.1);
      ASSERT_TRUE(motion.rounding);
      const Vec2 along = Eigen::Rotation2Dd(angle) * Vec2(vertex == 0 ? 0.1 : -0.1, 0);
      EXPECT_LE((motion.slip_positions().i - motion.start.i - along).norm(), 1e-9);
      EXPECT_NEAR(gap_at_rest(motion, built.stepper->blocks().n_unknowns()), 0, 1e-9);
    }
  }
}

TEST(ContactPositions, RoundedCornersTouchWhereTheirCirclesDo) {
  for (const double angle : {0., 0.7}) {
    BuiltScene built = block_on_a_plate(angle);
    BlockSystem& blocks = blocks_of(built);
    blocks.round_corners(0.1);
    const double r = blocks.rounded(2).radius;
    const Eigen::Rotation2Dd R(angle);
    const MovingVertexEdge motion = motion_of(blocks, built.stepper->state(), {2, 0, 1, 2});
    EXPECT_NEAR(motion.start_gap(), 0, 1e-9);
    EXPECT_LE((motion.slip_positions().i - motion.start.i - R * Vec2(r, 0)).norm(), 1e-9);
    // Against the corner at the plate's right end, from its circle's centre.
    const MovingVertexEdge corner = motion_of(blocks, built.stepper->state(), {2, 0, 1, 2, true});
    EXPECT_NEAR(corner.start_gap(), Vec2(5 - r, r).norm() - r, 1e-9);
    const VertexEdgePositions line = corner.slip_positions();
    EXPECT_LE(((line.j + line.k) / 2 - corner.start.j).norm(), 1e-9) << "half way at the corner";
    EXPECT_NEAR((line.k - line.j).dot(R * Vec2(r - 5, r)), 0, 1e-8) << "across the line to the centre";
    // Against the arc there: the line touches both circles.
    const double of_corner = 0.6 * r, apart = Vec2(5 - r - of_corner, r + of_corner).norm();
    const MovingVertexEdge arc = motion_of(blocks, built.stepper->state(), {2, 0, 1, 2, true}, 0, of_corner);
    EXPECT_NEAR(arc.start_gap(), apart - r - of_corner, 1e-9);
    const VertexEdgePositions at_arc = arc.slip_positions();
    const Vec2 middle = (at_arc.j + at_arc.k) / 2, away = (at_arc.i - middle).normalized();
    EXPECT_NEAR((at_arc.i - middle).norm(), apart - r - of_corner, 1e-9);
    EXPECT_NEAR((at_arc.k - at_arc.j).dot(away), 0, 1e-8);
    EXPECT_LE((middle - arc.start.j - R * Vec2(-of_corner, -of_corner) - of_corner * away).norm(), 1e-9);
  }
}

TEST(ContactPositions, VerticesAreExchangedWhereCornersMeetAndEachIsOnAnEdgeOfTheOther) {
  Scene scene = rock_scene(0.1, 1);
  scene.blocks = {block(rectangle(0, 0, 1, 1)), block(rectangle(1, 1.005, 1, 1))};
  const BuiltScene built = build(scene);
  const auto exchanged = [&](const VertexEdge& old, const VertexEdge& pair, double near = 0.01) {
    return exchange_vertices(built.stepper->blocks(), built.stepper->state(), near, old, pair);
  };
  const VertexEdge lower{0, 2, 1, 0}, upper{1, 0, 0, 2};  // the corner (1, 1) under the upper block, and back
  EXPECT_TRUE(exchanged(lower, upper));
  EXPECT_TRUE(exchanged(upper, lower));
  EXPECT_TRUE(exchanged(lower, {1, 0, 0, 1})) << "on the edge that ends there";
  EXPECT_FALSE(exchanged(lower, upper, 0.004)) << "too far apart";
  EXPECT_FALSE(exchanged(lower, lower)) << "of the same block";
  EXPECT_FALSE(exchanged(lower, {1, 0, 0, 0})) << "on an edge that does not meet the corner";
  EXPECT_FALSE(exchanged({0, 2, 1, 1}, upper));
  EXPECT_FALSE(exchanged(lower, {1, 0, 0, 2, true}));
}
