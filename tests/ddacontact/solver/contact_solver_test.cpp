#include <ddacontact/solver/contact_solver.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <limits>

using namespace support;

namespace {

/// A block of 40 kN at rest on a fixed plane that is tilted with it, method "staged".
Scene resting(double stiffness, double angle, double friction_degrees) {
  Scene scene = rock_scene(0.05, 20);
  scene.analysis.mode = Mode::statics;
  scene.analysis.kinematics = Kinematics::corotational;
  scene.analysis.scheme = Scheme::decaying;
  scene.contact = {ContactMethod::staged, stiffness, 0.4 * stiffness, 1e-6};
  scene.joints[0].friction_angle = friction_degrees;
  scene.blocks = {block(turned(rectangle(-4, -1, 10, 1), angle), true),
                  block(turned(rectangle(0, 0, 2, 1), angle))};
  return scene;
}

/// The first step of a scene, to be solved.
struct FirstStep {
  BuiltScene built;
  StepSystem system;
  std::vector<Contact> contacts;
  VectorXd d;

  explicit FirstStep(const Scene& scene)
      : built(build(scene)), system(blocks_of(built)), contacts(built.stepper->contacts_to_begin_with()) {
    const BlockState& state = built.stepper->state();
    system.set_step(state, step_start(state, 0.05), 1e9);
    d = system.prescribed();
  }
  ContactSolverReport solve(const ContactSolverOptions& options = {}) {
    return solve_contacts(system, options, contacts, d);
  }
};

}  // namespace

TEST(ContactSolver, TheContactsStiffnessChangesNeitherForcesNorPlaces) {
  Vec2 first = Vec2::Zero();
  for (double factor : {1., 10., 100., 1000.}) {
    const BuiltScene built = run(resting(factor * 1e8, 0, 30));
    double normal = 0;
    for (const ContactRecord& c : built.stepper->contacts()) {
      normal += c.normal;
      EXPECT_LE(c.closed() ? -c.end_gap : 0, 1e-6 * built.stepper->blocks().block(1).size());
    }
    EXPECT_NEAR(normal, 40e3, 1e-6 * 40e3);
    if (factor == 1) first = travel(*built.stepper, 1);
    EXPECT_LE((travel(*built.stepper, 1) - first).norm(), 2e-6 * std::sqrt(2)) << factor;
  }
}

/// A static step starts at rest: each slides by dt^2 times the acceleration that friction leaves.
TEST(ContactSolver, ABlockStaysOnASlopeBelowItsFrictionAngleAndSlidesAboveIt) {
  for (double degrees : {10., 30.}) {
    const double slope = radians(degrees), mu = std::tan(radians(degrees - 0.1));
    const Vec2 prescribed = travel(*run(resting(4e9, slope, degrees + 0.1)).stepper, 1),
               slid = travel(*run(resting(4e9, slope, degrees - 0.1)).stepper, 1);
    const double law = 20 * 0.05 * 0.05 * 10 * (std::sin(slope) - mu * std::cos(slope));
    EXPECT_LT(prescribed.norm(), 2.5e-4);  // it settles by its own weight
    EXPECT_NEAR((slid - prescribed).norm(), law, 0.1 * law);
  }
}

TEST(ContactSolver, EndsWhereDisplacementsAreNotFiniteBeforeContactsAreEvaluatedThere) {
  FirstStep step(resting(1e9, 0, 30));
  step.d.setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(step.solve().status, SolutionStatus::not_finite);
}

/// A heavy block rests on the floor, and two light ones, one of which overhangs its base, are pushed in turn.
TEST(ContactSolver, NamesAContactOfTheBlockThatIsFurthestFromBalance) {
  for (int pushed : {3, 4}) {
    Scene scene = resting(4e9, 0, 30);
    scene.blocks = {block(rectangle(-4, -1, 10, 1), true), block(rectangle(0, 0, 4, 4)),
                    block(rectangle(10, -1, 1, 1), true), block(rectangle(9, 0, 3, 0.5)),
                    block(rectangle(-2, 0, 1, 0.5))};
    scene.loads = {point_load(pushed, scene.blocks[static_cast<std::size_t>(pushed)].vertices.col(2),
                              constant({2e5, -2e5}))};
    FirstStep step(scene);
    ContactSolverOptions options({}, 1e-6);
    options.max_solutions = 1;
    const ContactSolverReport report = step.solve(options);
    EXPECT_EQ(report.status, SolutionStatus::forces_unsettled);
    EXPECT_EQ(report.residual.worst_block, pushed);
    ASSERT_GE(report.worst_contact, 0);
    const VertexEdge& named = step.contacts[static_cast<std::size_t>(report.worst_contact)].pair;
    EXPECT_TRUE(named.vertex_block == pushed || named.edge_block == pushed);
  }
}

/// With springs alone, which a warm start leaves as they are: a block lies on a slope, or hangs by its bond.
TEST(ContactSolver, AWarmStartFromTheSolutionIsTheSolution) {
  for (bool hangs : {false, true}) {
    Scene scene = resting(4e9, 0.2, 30);
    if (hangs) {
      scene.joints[0].cohesion = scene.joints[0].tensile_strength = 1e6;
      scene.blocks[0] = block(turned(rectangle(-4, 1, 10, 1), 0.2), true);
    }
    FirstStep cold(scene), warm(scene);
    ContactSolverOptions options;
    EXPECT_GT(cold.solve(options).iterations, 0);
    for (std::size_t c = 0; c < warm.contacts.size(); ++c) {
      warm.contacts[c].normal = cold.contacts[c].normal;
      warm.contacts[c].shear = cold.contacts[c].shear;
    }
    warm.d = cold.d;
    options.warm_start = true;
    const ContactSolverReport again = warm.solve(options);
    EXPECT_EQ(again.status, SolutionStatus::settled);
    EXPECT_EQ(again.iterations, 0) << hangs;
  }
}
