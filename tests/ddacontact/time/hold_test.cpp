#include <ddacontact/time/hold.hpp>
#include <tests/ddacontact/time/touching_blocks.hpp>

#include <gtest/gtest.h>

#include <random>

using namespace support;

namespace {

/// A wall of heavy and light blocks whose contacts are held, some of them along their edges too.
struct HeldWall {
  TouchingBlocks scene{wall(3, 3), 0, 0, {500, 2000, 20000}};
  std::vector<HeldContact> held;
  std::mt19937 random;

  explicit HeldWall(int seed) : random(seed) {
    for (int b = 1; b < scene.blocks.n_blocks(); ++b)
      scene.set_velocity(b, {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)});
    for (const ImpactContact& contact : scene.contacts)
      held.push_back({contact.gap, contact.slip, uniform(0, 1) < 0.3});
  }
  double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random); }

  /// The impulses on all unknowns.
  VectorXd force(const HeldJump& jump) const {
    VectorXd sum = VectorXd::Zero(scene.v.size());
    for (std::size_t c = 0; c < held.size(); ++c) {
      held[c].gap.add_gradient(jump.normal[static_cast<Index>(c)], sum);
      held[c].slip.add_gradient(jump.shear[static_cast<Index>(c)], sum);
    }
    return sum;
  }
  /// The rigid motions that impulses on all unknowns make, block by block.
  VectorXd moved_by(const VectorXd& force) const {
    VectorXd v = VectorXd::Zero(force.size());
    for (int b = 1; b < scene.blocks.n_blocks(); ++b) {
      const Block& block = scene.blocks.block(b);
      const Range& u = block.unknowns();
      const auto modes = block.rigid_modes();
      const Vec3 inertia = (modes.transpose() * block.mass() * modes).diagonal();
      v.segment(u.first, u.count) =
          modes * (modes.transpose() * force.segment(u.first, u.count)).cwiseQuotient(inertia);
    }
    return v;
  }
};

}  // namespace

TEST(Hold, TakesTheRatesOutAtLeastEnergy) {
  HoldFactor factor;
  for (int seed = 0; seed < 30; ++seed) {
    const HeldWall wall(seed);
    const TouchingBlocks& scene = wall.scene;
    const Hold hold(scene.blocks, wall.held, 0, factor);
    const VectorXd jump = hold.jump(scene.v), after = scene.v + jump;
    for (const HeldContact& contact : wall.held) {
      EXPECT_NEAR(contact.gap.change(after), 0, 1e-6);
      if (contact.tangential) {
        EXPECT_NEAR(contact.slip.change(after), 0, 1e-6);
      }
    }
    // least: what is left is orthogonal to the jump, and the jump comes from impulses
    const double lost = scene.energy(scene.v) - scene.energy(after);
    EXPECT_NEAR(lost, scene.energy(jump), 1e-6 * scene.energy(scene.v));
    const HeldJump again = hold.with_friction(jump, {});
    EXPECT_LE((again.velocity - jump).norm(), 1e-6 * jump.norm());
    EXPECT_LE((wall.moved_by(wall.force(again)) - jump).norm(), 1e-6 * jump.norm());
  }
}

TEST(Hold, FrictionGoesWithTheImpulses) {
  HoldFactor factor;
  for (int seed = 0; seed < 30; ++seed) {
    HeldWall wall(seed);
    const TouchingBlocks& scene = wall.scene;
    std::vector<HeldFriction> friction(wall.held.size());
    for (std::size_t c = 0; c < friction.size(); ++c)
      if (!wall.held[c].tangential) friction[c] = {wall.uniform(-0.3, 0.3), wall.uniform(-1, 1)};
    const Hold hold(scene.blocks, wall.held, 0, factor);
    const HeldJump jump = hold.with_friction(hold.jump(scene.v), friction);
    for (std::size_t c = 0; c < friction.size(); ++c) {
      const auto k = static_cast<Index>(c);
      EXPECT_NEAR(wall.held[c].gap.change(scene.v + jump.velocity), 0, 1e-6);
      if (wall.held[c].tangential) continue;
      EXPECT_NEAR(jump.shear[k], friction[c].rate * jump.normal[k] + friction[c].given,
                  1e-9 * jump.normal.norm());
    }
    EXPECT_LE((wall.moved_by(wall.force(jump)) - jump.velocity).norm(), 1e-6 * jump.velocity.norm());
  }
}

/// A block that swells on the floor and under another cannot be kept from it by moving as a whole.
TEST(Hold, ContradictingRatesAreLeftWithoutMakingEnergy) {
  TouchingBlocks scene({floor_block, block(rectangle(0, 0, 1, 1)), block(rectangle(0, 1, 1, 1))}, 0, 0);
  for (int b : {1, 2}) {
    const Range& u = scene.blocks.block(b).unknowns();
    for (int k = 0; k < 4; ++k) scene.v.segment(u.first + 2 * k, 2) = scene.vertex(b, k) - scene.centroid(b);
  }
  std::vector<HeldContact> held;
  for (const ImpactContact& contact : scene.contacts) held.push_back({contact.gap, contact.slip, true});
  HoldFactor factor;
  const VectorXd jump = Hold(scene.blocks, held, 0, factor).jump(scene.v);
  EXPECT_LE(scene.energy(scene.v + jump), scene.energy(scene.v) * (1 + 1e-12));
  scene.set_velocity(1, {0.3, -2, 0.1});
  const VectorXd moving = Hold(scene.blocks, held, 0, factor).jump(scene.v);
  EXPECT_TRUE(moving.allFinite());
  EXPECT_LE(scene.energy(scene.v + moving), scene.energy(scene.v) * (1 + 1e-12));
}

/// Velocities below what is negligible may be left, others not.
TEST(Hold, FindsVelocitiesToWhatIsNegligible) {
  for (int seed = 0; seed < 10; ++seed) {
    const HeldWall wall(seed);
    HoldFactor factor;
    const VectorXd whole = Hold(wall.scene.blocks, wall.held, 0, factor).jump(wall.scene.v);
    for (const double part : {1e-1, 1e-3, 1e-5}) {
      const double negligible = part * whole.lpNorm<Eigen::Infinity>();
      const VectorXd rough = Hold(wall.scene.blocks, wall.held, negligible, factor).jump(wall.scene.v);
      const double off = (rough - whole).lpNorm<Eigen::Infinity>();
      EXPECT_LE(off, negligible);
      if (part == 1e-1) {
        EXPECT_GT(off, 0);
      }
    }
  }
}

/// The factor of another wall, or of the same one, changes nothing; of the same one its analysis serves
/// again.
TEST(Hold, FindsTheSameWhateverItsFactorWasMadeFor) {
  HoldFactor kept;
  for (int seed = 0; seed < 10; ++seed) {
    const HeldWall wall(seed);
    HoldFactor fresh;
    const VectorXd jump = Hold(wall.scene.blocks, wall.held, 0, fresh).jump(wall.scene.v);
    for (int twice = 0; twice < 2; ++twice) {
      const int n_analyses = kept.cholesky.n_analyses();
      EXPECT_EQ(Hold(wall.scene.blocks, wall.held, 0, kept).jump(wall.scene.v), jump);
      if (twice == 1) {
        EXPECT_EQ(kept.cholesky.n_analyses(), n_analyses);
      }
    }
  }
}
