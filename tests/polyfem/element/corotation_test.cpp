// Laws of a turning element that do not depend on its shape or on how far it turns.
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/corotation.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <tests/support/random_polygon.hpp>

#include "corotated_block.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

using namespace polyfem;
using namespace support;

namespace {

CorotatedFrame frame_of(const CorotatedElement& element, const Points& nodes) {
  CorotatedFrame frame;
  element.frame(nodes, frame);
  return frame;
}

/// In (-pi, pi].
double angle_of(const CorotatedFrame& frame) {
  return std::atan2(frame.rotation(1, 0), frame.rotation(0, 0));
}

class Corotation : public testing::TestWithParam<int> {
 protected:
  /// Random blocks of sizes 1e-3 to 1e3.
  template <class Law>
  void for_blocks(Law&& law) {
    for (const double size : {1e-3, 1., 1e3})
      for (int trial = 0; trial < 10; ++trial)
        law(Block(size * support::random_convex_polygon(GetParam(), random_), anisotropic(),
                  Vec3(0.01, -0.02, 0.015)));
  }

  double any_angle() { return support::uniform(-pi, pi, random_); }

  /// The block turned and shifted with strains up to about `strain`, different at each node.
  Points place(const Block& block, double angle, double strain) {
    const Points strained =
        block.polygon + random_points(block.polygon.cols(), strain * block.size / 2, random_);
    return (turn(angle) * strained).colwise() + Vec2(random_points(1, block.size, random_));
  }

  /// Two positions of a step that turns by up to 2 rad.
  void step(const Block& block, double strain) {
    const double angle = any_angle();
    y0_ = place(block, angle, strain);
    y1_ = place(block, angle + support::uniform(-2, 2, random_), strain);
    block.element.frame(y0_, start_);
    block.element.frame(y1_, end_);
  }

  static double energy(const Block& block, const Points& nodes) {
    return block.element.energy(frame_of(block.element, nodes), block.initial_force);
  }

  static VectorXd end_force(const Block& block, const Points& nodes) {
    VectorXd f;
    block.element.end_force(frame_of(block.element, nodes), block.initial_force, f);
    return f;
  }

  std::mt19937 random_{static_cast<unsigned>(GetParam())};
  Points y0_, y1_;
  CorotatedFrame start_, end_;
  VectorXd f_;
};
INSTANTIATE_TEST_SUITE_P(Vertices, Corotation, testing::Values(3, 4, 5, 6, 8, 12));

TEST_P(Corotation, EndForceIsTheGradientOfTheEnergy) {
  for_blocks([this](const Block& block) {
    const Points y = place(block, any_angle(), 0.1);
    const Points h = random_points(y.cols(), 1e-5 * block.size, random_);
    const double difference = (energy(block, y + h) - energy(block, y - h)) / 2;
    const VectorXd f = end_force(block, y);
    EXPECT_NEAR(difference, f.dot(stacked(h)), 1e-8 * f.norm() * h.norm());
  });
}

TEST_P(Corotation, EndTangentIsTheGradientOfTheEndForce) {
  for_blocks([this](const Block& block) {
    const Points y = place(block, any_angle(), 0.1);
    const Points h = random_points(y.cols(), 1e-5 * block.size, random_);
    MatrixXd T;
    block.element.end_tangent(frame_of(block.element, y), block.initial_force, T);
    const VectorXd difference = (end_force(block, y + h) - end_force(block, y - h)) / 2;
    EXPECT_LT((difference - T * stacked(h)).norm(), 1e-8 * T.norm() * h.norm());
    EXPECT_LT((T - T.transpose()).norm(), 1e-15 * T.norm());
  });
}

/// Relative to K, per strain: not above 5.
TEST_P(Corotation, TurnedStiffnessIsTheEndTangentButForTermsOfTheStrain) {
  double worst = 0;
  for (const double strain : {1e-1, 1e-3, 1e-5})
    for (int trial = 0; trial < 30; ++trial) {
      const Block block(support::random_convex_polygon(GetParam(), random_), anisotropic(), Vec3::Zero());
      const CorotatedFrame frame = frame_of(block.element, place(block, any_angle(), strain));
      MatrixXd exact, turned;
      block.element.end_tangent(frame, block.initial_force, exact);
      rotate(block.element.stiffness(), frame.rotation, turned);
      worst = std::max(worst, (exact - turned).norm() / turned.norm() / strain);
    }
  EXPECT_LT(worst, 5);
}

TEST_P(Corotation, EndForceHasNoResultantAndNoMoment) {
  for_blocks([this](const Block& block) {
    const Points y = place(block, any_angle(), 0.1);
    const VectorXd f = end_force(block, y);
    EXPECT_LT(resultant(f).norm(), 1e-14 * f.norm());
    EXPECT_LT(std::abs(moment(f, y)), 2e-14 * f.norm() * block.size);
  });
}

TEST_P(Corotation, EnergyAndForceTurnWithTheElement) {
  for_blocks([this](const Block& block) {
    const Points y = place(block, any_angle(), 0.1);
    const Mat2 R = turn(any_angle());
    const Vec2 shift = random_points(1, block.size, random_);
    const Points turned = (R * y).colwise() + shift;
    const VectorXd f = end_force(block, y), expected = stacked(R * f.reshaped(2, y.cols()));
    EXPECT_NEAR(energy(block, turned), energy(block, y), 1e-14 * f.norm() * block.size);
    EXPECT_LT((end_force(block, turned) - expected).norm(),
              1e-15 * block.element.stiffness().norm() * block.size);
  });
}

TEST_P(Corotation, MeanForceDoesTheWorkOfTheEnergyInAnyStep) {
  double worst = 0;
  for (const double strain : {0.1, 1e-4})
    for_blocks([&](const Block& block) {
      step(block, strain);
      block.element.mean_force(start_, end_, 0, block.initial_force, f_);
      const double gained = energy(block, y1_) - energy(block, y0_);
      const Points moved = y1_ - y0_;
      worst = std::max(worst, std::abs(f_.dot(stacked(moved)) - gained) / (f_.norm() * moved.norm()));
    });
  EXPECT_LT(worst, 1e-14);
}

TEST_P(Corotation, ChiDissipatesTheEnergyOfTheStrainIncrement) {
  for (const double chi : {0.1, 0.5})
    for_blocks([&](const Block& block) {
      step(block, 0.1);
      block.element.mean_force(start_, end_, chi, block.initial_force, f_);
      const VectorXd increment = end_.u - start_.u;
      const double lost = chi * increment.dot(block.element.stiffness() * increment);
      const Points moved = y1_ - y0_;
      EXPECT_GT(lost, 0);
      EXPECT_NEAR(f_.dot(stacked(moved)), energy(block, y1_) - energy(block, y0_) + lost,
                  1e-14 * f_.norm() * moved.norm());
    });
}

TEST_P(Corotation, MeanForceHasNoResultantAndNoMomentAboutTheMidConfiguration) {
  for (const double chi : {0., 0.2, 0.5})
    for_blocks([&](const Block& block) {
      step(block, 0.1);
      block.element.mean_force(start_, end_, chi, block.initial_force, f_);
      EXPECT_LT(resultant(f_).norm(), 1e-14 * f_.norm());
      EXPECT_LT(std::abs(moment(f_, (y0_ + y1_) / 2)), 3e-14 * f_.norm() * block.size);
    });
}

TEST_P(Corotation, MeanForceIsTheSameBackwards) {
  for_blocks([this](const Block& block) {
    step(block, 0.1);
    VectorXd backwards;
    block.element.mean_force(start_, end_, 0, block.initial_force, f_);
    block.element.mean_force(end_, start_, 0, block.initial_force, backwards);
    EXPECT_LT((f_ - backwards).norm(), 1e-14 * f_.norm());
  });
}

/// Angles of the two frames differ by almost 2 pi, the turn is small.
TEST_P(Corotation, StepsAcrossHalfATurnAreLikeAnyOther) {
  for_blocks([this](const Block& block) {
    const Points before = place(block, -1e-3, 1e-4), after = place(block, 1e-3, 1e-4);
    for (const double angle : {pi, -pi, pi + 5e-4, pi - 5e-4}) {
      const Mat2 R = turn(angle);
      const CorotatedFrame start = frame_of(block.element, R * before);
      const CorotatedFrame end = frame_of(block.element, R * after);
      EXPECT_GT(std::abs(angle_of(end) - angle_of(start)), 6);
      VectorXd plain;
      block.element.mean_force(start, end, 0, block.initial_force, f_);
      block.element.mean_force(frame_of(block.element, before), frame_of(block.element, after), 0,
                               block.initial_force, plain);
      EXPECT_LT((f_ - stacked(R * plain.reshaped(2, before.cols()))).norm(),
                1e-15 * block.element.stiffness().norm() * block.size);
    }
  });
}

TEST_P(Corotation, HomogeneousDeformationHasItsPolarRotationAndTheStressOfBiotsStrain) {
  const Mat3 D = elasticity_matrix(1, 0.3, Plane::strain);
  for (const double size : {1e-3, 1., 1e3})
    for (int trial = 0; trial < 10; ++trial) {
      const Block block(size * support::random_convex_polygon(GetParam(), random_), D, Vec3::Zero());
      const Mat2 Q = turn(any_angle()), R = turn(any_angle());
      const Vec2 principal(support::uniform(-0.1, 0.1, random_), support::uniform(-0.1, 0.1, random_));
      const Mat2 biot = Q * principal.asDiagonal() * Q.transpose();
      const Points y = (R * (Mat2::Identity() + biot) * block.polygon).colwise() + Vec2(size, -size);
      const CorotatedFrame frame = frame_of(block.element, y);
      EXPECT_LT((frame.rotation - R).norm(), 1e-14);
      EXPECT_LT((frame.rotation * frame.rotation.transpose() - Mat2::Identity()).norm(), 1e-15);
      EXPECT_NEAR(frame.stretch, 2 + principal.sum(), 1e-14);

      Tensors strain;
      strains(block.tabulated, frame.u, strain);
      const Vec3 expected(biot(0, 0), biot(1, 1), 2 * biot(0, 1));
      EXPECT_LT((strain.colwise() - expected).colwise().norm().maxCoeff(), 3e-14);
      VectorXd forces(2 * y.cols());
      stress_forces(block.tabulated, (D * expected).replicate(1, strain.cols()), forces);
      EXPECT_LT((end_force(block, y) - stacked(R * forces.reshaped(2, y.cols()))).norm(), 1e-14 * size);
    }
}

TEST_P(Corotation, AnAffineBlockIsThePolygonInAffineMotions) {
  for_blocks([this](const Block& block) {
    Points affine[2], y[2];
    CorotatedFrame affine_frame[2], frame[2];
    VectorXd f, affine_f;
    const double angle = any_angle();
    const double round_off = 1e-15 * block.element.stiffness().norm() * block.size * block.size;
    for (const int i : {0, 1}) {
      const Mat2 F = turn(angle + i) * (Mat2::Identity() + Mat2(random_points(2, 0.1, random_)));
      const Vec2 c = random_points(1, block.size, random_);
      affine[i].resize(2, 3);
      affine[i] << c, F;
      y[i] = (F * (block.polygon.colwise() - block.centre)).colwise() + c;
      block.affine.frame(affine[i], affine_frame[i]);
      block.element.frame(y[i], frame[i]);
      EXPECT_NEAR(angle_of(affine_frame[i]), angle_of(frame[i]), 1e-14);
      block.element.end_force(frame[i], block.initial_force, f);
      block.affine.end_force(affine_frame[i], block.affine_initial_force, affine_f);
      EXPECT_LT((affine_f - block.affine_forces(f)).tail<4>().norm(), round_off);
      EXPECT_EQ(affine_f.head<2>(), Vec2::Zero());
      EXPECT_NEAR(block.affine.energy(affine_frame[i], block.affine_initial_force),
                  block.element.energy(frame[i], block.initial_force), round_off);
    }
    block.element.mean_force(frame[0], frame[1], 0.2, block.initial_force, f);
    block.affine.mean_force(affine_frame[0], affine_frame[1], 0.2, block.affine_initial_force, affine_f);
    EXPECT_LT((affine_f - block.affine_forces(f)).tail<4>().norm(), round_off);
    EXPECT_EQ(affine_f.head<2>(), Vec2::Zero());
  });
}

TEST_P(Corotation, RigidMotionsLeaveRoundOff) {
  double worst = 0;
  for_blocks([&](const Block& block) {
    CorotatedFrame frame;
    for (int trial = 0; trial < 600; ++trial) {
      block.element.frame(place(block, any_angle(), 0), frame);
      worst = std::max({worst, frame.u.norm() / block.size, std::abs(frame.stretch - 2)});
    }
  });
  EXPECT_LT(worst, 1e-14);
}

/// Were the translation left in u, K u would have it times the round-off of K as a resultant.
TEST_P(Corotation, ResultantsAreRoundOffOfTheForcesNotOfTheTranslation) {
  for_blocks([this](const Block& block) {
    const double strain = 1e-8;
    Points y = place(block, any_angle(), strain);
    y.colwise() += Vec2(30 * block.size, -10 * block.size);
    VectorXd f;
    block.element.end_force(frame_of(block.element, y), VectorXd::Zero(2 * y.cols()), f);
    EXPECT_LT(resultant(f).norm(), 1e-14 * strain * block.element.stiffness().norm() * block.size);
  });
}

TEST_P(Corotation, MidRotationIsHalfWayTheShorterWay) {
  for_blocks([this](const Block& block) {
    const double angle = any_angle(), D = support::uniform(-3, 3, random_);
    block.element.frame(place(block, angle, 0), start_);
    block.element.frame(place(block, angle + D, 0), end_);
    EXPECT_LT((mid_rotation(start_.rotation, end_.rotation) - turn(angle + D / 2)).norm(), 1e-13);
  });
}

TEST(CorotatedFrames, OfCollapsedAndMirroredElementsHaveNoStretchAndNoNaN) {
  const Points square = support::regular_polygon(4);
  const Block block(square, anisotropic(), Vec3::Zero());
  const Mat2 mirror = Vec2(1, -1).asDiagonal();
  for (const Mat2& F : {Mat2(Mat2::Zero()), mirror}) {
    const CorotatedFrame frame = frame_of(block.element, F * square);
    EXPECT_NEAR(frame.stretch, 0, 1e-15);
    EXPECT_LT((frame.rotation * frame.rotation.transpose() - Mat2::Identity()).norm(), 1e-15);
    EXPECT_TRUE(frame.u.allFinite());
  }
}

TEST(RotateMatrix, IsTheCongruenceOfEachBlockAndWorksInPlace) {
  const MatrixXd A = MatrixXd::Random(6, 6);
  const Mat2 R = turn(0.7);
  MatrixXd all = MatrixXd::Zero(6, 6), turned, in_place = A;
  for (Index i = 0; i < 6; i += 2) all.block<2, 2>(i, i) = R;
  rotate(A, R, turned);
  rotate(in_place, R, in_place);
  EXPECT_TRUE(turned.isApprox(all * A * all.transpose(), 1e-15));
  EXPECT_EQ(in_place, turned);
}

}  // namespace
