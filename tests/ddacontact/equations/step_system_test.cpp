#include <ddacontact/classic/incremental_block.hpp>
#include <ddacontact/equations/step_system.hpp>
#include <tests/ddacontact/simple_scenes.hpp>
#include <tests/support/block_tangent.hpp>

#include <gtest/gtest.h>

using namespace support;
using enum ContactState;

namespace {

constexpr double dt = 0.01, fixed_point_stiffness = 1e9;

/// A vertex block and an affine one side by side on a fixed block, with loads, initial stress and, of the
/// paper's preset, a vertex held by springs.
Scene loaded_scene() {
  Scene scene = rock_scene(dt, 10);
  scene.analysis.preset = Preset::paper;
  scene.joints[0].friction_angle = 30;
  scene.blocks = {block(rectangle(0, -1, 5, 1), true), block(rectangle(1, 0, 1, 1)),
                  block(rectangle(2, 0, 2, 1))};
  scene.blocks[1].stress = {1e3, -2e3, 5e2};
  scene.blocks[2].model = BlockModel::affine;
  scene.blocks[2].velocity = {0.1, -0.2};
  scene.supports = {{2, {2}, true, true, {TimeFunction::Kind::rate, {0.01, 0}, {}}}};
  scene.loads = {point_load(1, {1.5, 0.5}, constant({1e3, -2e3})), pressure_load(2, 2, 1e4)};
  return scene;
}

struct Prepared {
  BuiltScene built;
  BlockSystem& blocks;
  const BlockState& state;
  std::vector<Contact> contacts;
  StepSystem system;

  explicit Prepared(const Scene& scene)
      : built(build(scene)),
        blocks(blocks_of(built)),
        state(built.stepper->state()),
        contacts(built.stepper->contacts_to_begin_with()),
        system(blocks) {
    system.problem().contacts_changed();
    system.set_step(state, step_start(state, dt), fixed_point_stiffness);
  }
  void set_states(std::initializer_list<ContactState> cycle) {
    std::size_t c = 0;
    for (Contact& contact : contacts) contact.history.state = cycle.begin()[c++ % cycle.size()];
  }
  std::vector<ContactTerm> terms() const {
    std::vector<ContactTerm> all;
    for (const Contact& c : contacts)
      all.push_back({.gap = c.motion.form(c.first_gap()),
                     .slip = c.motion.form(c.first_slip()),
                     .normal_stiffness = c.law.normal_stiffness,
                     .tangential_stiffness = c.law.tangential_stiffness});
    return all;
  }
  /// Of springs on the gap of the closed contacts, and on the slip of those that stick.
  std::vector<unsigned char> springs() const {
    std::vector<unsigned char> all;
    for (const Contact& c : contacts) all.push_back(!c.closed() ? 0 : c.history.state == stick ? 3 : 1);
    return all;
  }
  std::vector<ContactForce> spring_forces(const VectorXd& d) const {
    std::vector<ContactForce> forces(contacts.size());
    const std::vector<ContactTerm> terms = this->terms();
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const Contact& of = contacts[c];
      if (of.closed())
        forces[c].normal = -of.law.normal_stiffness * (terms[c].gap(d) - of.history.gap_offset);
      if (of.history.state == stick) forces[c].shear = -of.law.tangential_stiffness * terms[c].slip(d);
    }
    return forces;
  }
  VectorXd residual(const VectorXd& d, const std::vector<ContactForce>& forces) const {
    Residual r;
    system.compute_residual(d, contacts, terms(), forces, r);
    return r.force;
  }
  VectorXd residual(const VectorXd& d) const { return residual(d, spring_forces(d)); }
};

/// The energy whose gradient (13) is: of inertia, blocks, springs, and the potential of stress and loads.
double potential(const Prepared& p, const VectorXd& d) {
  double energy = 0;
  VectorXd F = VectorXd::Zero(d.size());
  p.blocks.add_gravity(F);
  p.blocks.add_loads(p.state, p.state.time + dt, F);
  for (int b = 0; b < p.blocks.n_blocks(); ++b) {
    const auto& of = dynamic_cast<const IncrementalBlock&>(p.blocks.block(b));
    const VectorXd d_b = d.segment(of.unknowns().first, of.n_unknowns());
    const VectorXd v_b = p.state.velocity.segment(of.unknowns().first, of.n_unknowns());
    energy +=
        d_b.dot(of.stiffness() * d_b) / 2 + (d_b - dt * v_b).dot(of.mass() * (d_b - dt * v_b)) / (dt * dt);
    of.add_stress_forces(p.state, F);
  }
  energy -= F.dot(d);
  for (const Contact& c : p.contacts) {
    if (!c.closed()) continue;
    energy +=
        c.law.normal_stiffness * std::pow(c.motion.form(c.first_gap())(d) - c.history.gap_offset, 2) / 2;
    if (c.history.state == stick)
      energy += c.law.tangential_stiffness * std::pow(c.motion.form(c.first_slip())(d), 2) / 2;
  }
  for (const FixedVertex& prescribed : p.blocks.fixed_vertices) {
    const int v = p.blocks.block(prescribed.block).vertices().first + prescribed.vertex;
    const Vec2 stretch = p.blocks.displacements(p.state).col(v) +
                         p.blocks.block(prescribed.block).vertex_map(prescribed.vertex)(d) -
                         prescribed.motion.at(p.state.time + dt, p.blocks.end_time);
    energy += fixed_point_stiffness *
              (prescribed.x * stretch.x() * stretch.x() + prescribed.y * stretch.y() * stretch.y()) / 2;
  }
  return energy;
}

}  // namespace

TEST(StepSystem, TheResidualIsTheGradientOfTheStepsPotential) {
  Prepared p(loaded_scene());
  ASSERT_GE(p.contacts.size(), 5u);
  ASSERT_FALSE(p.blocks.fixed_vertices.empty());
  for (auto states :
       {std::initializer_list<ContactState>{stick}, {open}, {stick, open, slip_forward, slip_backward}}) {
    p.set_states(states);
    for (std::size_t c = 0; c < p.contacts.size(); ++c)
      p.contacts[c].history.gap_offset = -1e-4 * static_cast<double>(c);
    const VectorXd d = 1e-3 * VectorXd::Random(p.blocks.n_unknowns());
    const VectorXd r = p.residual(d);
    for (int k = 0; k < d.size(); ++k) {
      if (p.blocks.is_unchanging(0) && k < p.blocks.block(1).unknowns().first) continue;
      const VectorXd h = 1e-3 * VectorXd::Unit(d.size(), k);  // exact for a quadratic
      EXPECT_NEAR((potential(p, d + h) - potential(p, d - h)) / 2e-3, r[k], 1e-8 * r.norm())
          << "unknown " << k;
    }
  }
}

/// Whatever forces the contacts exert act along the derivatives of gap and slip, on both blocks.
TEST(StepSystem, ContactForcesWorkOnTheChangesOfGapAndSlip) {
  Prepared p(loaded_scene());
  p.set_states({open});
  const VectorXd d = 1e-3 * VectorXd::Random(p.blocks.n_unknowns());
  const VectorXd without = p.residual(d);
  std::vector<ContactForce> forces;
  for (std::size_t c = 0; c < p.contacts.size(); ++c)
    forces.push_back({1e4 * static_cast<double>(c + 1), -3e3 * static_cast<double>(c)});
  const VectorXd exerted = without - p.residual(d, forces);
  const std::vector<ContactTerm> terms = p.terms();
  for (int trial = 0; trial < 5; ++trial) {
    const VectorXd moved = VectorXd::Random(d.size());
    double work = 0, magnitude = 0;
    for (std::size_t c = 0; c < p.contacts.size(); ++c) {
      work += forces[c].normal * terms[c].gap.change(moved) + forces[c].shear * terms[c].slip.change(moved);
      magnitude += std::hypot(forces[c].normal, forces[c].shear);
    }
    EXPECT_NEAR(exerted.dot(moved), work, 1e-11 * (magnitude + without.norm()));
  }
}

TEST(StepSystem, OneSolutionOfTheFactoredEquationsLeavesNoResidual) {
  for (BlockModel model : {BlockModel::wachspress, BlockModel::affine}) {
    Scene scene = loaded_scene();
    scene.blocks[1].model = model;
    Prepared p(scene);
    p.set_states({stick, slip_forward});
    VectorXd d = p.system.prescribed(), correction;
    Residual r;
    p.system.compute_residual(d, p.contacts, p.terms(), p.spring_forces(d), r);
    EXPECT_FALSE(r.balanced(1e-8));
    p.system.linearize(d);
    ASSERT_TRUE(p.system.problem().factorize(p.terms(), p.springs()));
    p.system.problem().solve(r.force, correction);
    d -= correction;
    p.system.compute_residual(d, p.contacts, p.terms(), p.spring_forces(d), r);
    EXPECT_LE(r.largest, 1e-10 * r.scale);
    EXPECT_TRUE(r.balanced(1e-8));
    for (const PrescribedDof& prescribed : p.blocks.prescribed_dofs())
      EXPECT_EQ(correction[prescribed.unknown], 0);
  }
}

TEST(StepSystem, FactorizesOnlyWhenSpringsOrTheStepChange) {
  Prepared p(loaded_scene());
  FrictionProblem& problem = p.system.problem();
  const auto factorizations = [&] {
    EXPECT_TRUE(problem.factorize(p.terms(), p.springs()));
    return problem.cholesky().n_factorizations();
  };
  p.system.linearize(p.system.prescribed());
  p.set_states({slip_forward});
  EXPECT_EQ(factorizations(), 1);
  const int analyses = problem.cholesky().n_analyses();
  EXPECT_EQ(factorizations(), 1);
  p.set_states({slip_backward});  // the same springs
  EXPECT_EQ(factorizations(), 1);
  p.set_states({stick});
  EXPECT_EQ(factorizations(), 2);
  p.system.set_step(p.state, step_start(p.state, dt / 2), fixed_point_stiffness);
  p.system.linearize(p.system.prescribed());
  EXPECT_EQ(factorizations(), 3);
  EXPECT_EQ(problem.cholesky().n_analyses(), analyses);
  p.system.problem().contacts_changed();  // the same pattern
  EXPECT_EQ(factorizations(), 4);
  EXPECT_EQ(problem.cholesky().n_analyses(), analyses);
  p.contacts.pop_back();
  p.system.problem().contacts_changed();
  EXPECT_EQ(factorizations(), 5);
  EXPECT_EQ(problem.cholesky().n_analyses(), analyses + 1);
}

TEST(StepSystem, MatricesOfFixedBlocksAreMadeWhereAskedAndHaveNoEffect) {
  Scene scene = loaded_scene();
  Prepared without(scene);
  scene.analysis.skip.fixed_blocks = false;
  Prepared with(scene);
  ASSERT_TRUE(with.blocks.is_unchanging(0));
  const int n = without.system.problem().unknowns().n_elements();
  ASSERT_EQ(with.system.problem().unknowns().n_elements(), n + 1);
  Residual residuals[2];
  VectorXd corrections[2];
  int k = 0;
  for (Prepared* p : {&without, &with}) {
    p->set_states({stick, slip_forward});
    const VectorXd d = p->system.prescribed();
    p->system.linearize(d);
    p->system.compute_residual(d, p->contacts, p->terms(), p->spring_forces(d), residuals[k]);
    ASSERT_TRUE(p->system.problem().factorize(p->terms(), p->springs()));
    p->system.problem().solve(residuals[k].force, corrections[k]);
    ++k;
  }
  const Range& fixed = with.blocks.block(0).unknowns();
  EXPECT_EQ(with.system.problem().elements()[0],
            support::tangent_of(with.blocks.block(0), with.system.step(0), VectorXd::Zero(fixed.count)));
  EXPECT_GT(with.system.problem().elements()[0].norm(), 0);
  for (int e = 0; e < n; ++e)
    EXPECT_EQ(with.system.problem().elements()[e + 1], without.system.problem().elements()[e]);
  EXPECT_EQ(residuals[0].force, residuals[1].force);
  EXPECT_EQ(residuals[0].scale, residuals[1].scale);
  EXPECT_EQ(residuals[0].round_off, residuals[1].round_off);
  EXPECT_EQ(corrections[0], corrections[1]);
}

/// All forces on the system but those of supports are in the residual of its free and prescribed degrees of
/// freedom: the sum over rigid translations of everything knows no contact.
TEST(StepSystem, ContactForcesCancelInTheSumOverAllBlocks) {
  Prepared p(loaded_scene());
  const auto sum = [&] {
    const VectorXd r = p.residual(1e-3 * VectorXd::Ones(p.blocks.n_unknowns()));
    Vec2 total = Vec2::Zero();
    for (int b = 0; b < p.blocks.n_blocks(); ++b) {
      const Block& of = p.blocks.block(b);
      total += of.translations().transpose() * r.segment(of.unknowns().first, of.n_unknowns());
    }
    return total;
  };
  p.set_states({open});
  const Vec2 without = sum();
  for (auto states : {std::initializer_list<ContactState>{stick}, {slip_forward, stick, slip_backward}}) {
    p.set_states(states);
    EXPECT_LE((sum() - without).norm(), 1e-8 * without.norm());
  }
}
