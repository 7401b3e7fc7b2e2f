#include <ddacontact/solver/interior_point.hpp>
#include <ddacontact/solver/spring_state.hpp>
#include <tests/ddacontact/simple_scenes.hpp>
#include <tests/support/random_polygon.hpp>

using namespace support;

namespace {

constexpr double dt = 0.1;

/// Two blocks side by side on a fixed plane, each with one more on it; friction 0.5 unless said otherwise,
/// loads in their centres.
Scene stacks(const std::vector<Vec2>& loads, double friction = 0.5) {
  Scene scene = rock_scene(dt, 1);
  scene.analysis.mode = Mode::statics;
  scene.joints[0].friction_angle = std::atan(friction) * 180 / std::numbers::pi;
  scene.blocks = {block(rectangle(-2, -1, 12, 1), true), block(rectangle(0, 0, 3, 1)),
                  block(rectangle(5, 0, 3, 1)), block(rectangle(1, 1, 1, 1)), block(rectangle(6, 1, 1, 1))};
  for (int b = 1; b <= static_cast<int>(loads.size()); ++b) {
    const Points& vertices = scene.blocks[static_cast<std::size_t>(b)].vertices;
    scene.loads.push_back(
        point_load(b, vertices.rowwise().mean(), constant(loads[static_cast<std::size_t>(b - 1)])));
  }
  return scene;
}

/// Two rows of three blocks with slanting sides between fixed walls, pushed any way: they jam.
Scene jammed(unsigned seed, double friction) {
  std::mt19937 random(seed);
  const auto any = [&](double size) { return support::uniform(-size, size, random); };
  Scene scene = stacks({}, friction);
  scene.blocks = {block(rectangle(-1, -1, 1, 4), true), block(rectangle(3, -1, 1, 4), true),
                  block(rectangle(0, -1, 3, 1), true)};
  for (int row : {0, 1}) {
    const double x[] = {0, 1 + any(0.3), 2 + any(0.3), 3}, lean[] = {0, any(0.2), any(0.2), 0};
    for (int k = 0; k < 3; ++k) {
      Points outline = rectangle(0, row, 1, 1);
      outline.row(0) << x[k] - lean[k], x[k + 1] - lean[k + 1], x[k + 1] + lean[k + 1], x[k] + lean[k];
      scene.blocks.push_back(block(outline));
      scene.loads.push_back(
          point_load(3 + 3 * row + k, outline.rowwise().mean(), constant({any(2e5), any(2e5)})));
    }
  }
  return scene;
}

/// One step of the scene.
struct Found {
  BuiltScene built;
  StepSystem system;
  std::vector<Contact> contacts;
  std::vector<SweptLaw> laws;
  std::vector<ContactTerm> terms;
  std::vector<unsigned char> states;
  VectorXd d;
  InteriorReport report;
  double multiplier;

  /// \param[in] pressed  the force of each contact where its gap does not change, N per m
  explicit Found(const Scene& scene, double pressed = 0)
      : built(build(scene)),
        system(blocks_of(built)),
        contacts(built.stepper->contacts_to_begin_with()),
        terms(contacts.size()),
        states(contacts.size()),
        multiplier(pressed) {
    const BlockState& state = built.stepper->state();
    system.problem().contacts_changed();
    system.set_step(state, step_start(state, dt), 1e9);
    for (const Contact& contact : contacts) laws.push_back({&contact.law, 0, false});
    d = system.prescribed();
    report = find_interior_point_states(system, {contacts, laws, terms, [this] { evaluate_contacts(); }}, d,
                                        states);
    evaluate_contacts();
  }
  void evaluate_contacts() {
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const Contact& contact = contacts[c];
      terms[c] = {.gap = contact.motion.form(contact.first_gap()),
                  .slip = contact.motion.form(contact.first_slip()),
                  .normal_stiffness = contact.law.normal_stiffness,
                  .tangential_stiffness = contact.law.tangential_stiffness,
                  .normal_multiplier = multiplier,
                  .sheared = contact.law.has_friction()};
      terms[c].bound = shear_bound(contact.law, normal_spring(terms[c], d).clipped(), false);
    }
  }
  /// Whether the law's forces at d are balanced, and leave contacts in the states that were found.
  bool obeys_law() {
    std::vector<ContactForce> forces;
    bool same = report.found;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      forces.push_back(contact_force(terms[c], d));
      same = same && states[c] == state_at(terms[c], contacts[c].law, springs_at(terms[c], d));
    }
    Residual residual;
    system.compute_residual(d, contacts, terms, forces, residual);
    return same && residual.block_relative <= 1e-3;
  }
  void expect_law() {
    EXPECT_LE(report.solutions, 40);
    ASSERT_GE(contacts.size(), 8u);
    EXPECT_TRUE(obeys_law());
  }
  /// How many contacts of these two blocks are in this state.
  int count(int a, int b, unsigned char state) const {
    int n = 0;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const VertexEdge& pair = contacts[c].pair;
      n += std::minmax(pair.vertex_block, pair.edge_block) == std::minmax(a, b) && states[c] == state;
    }
    return n;
  }
};

}  // namespace

TEST(InteriorPoint, BlocksAtRestStick) {
  Found found(stacks({{0, 0}, {0, 0}, {0, 0}, {0, 0}}));
  found.expect_law();
  for (const auto& [a, b] : {std::pair(0, 1), {0, 2}, {1, 3}, {2, 4}})
    EXPECT_EQ(found.count(a, b, normal_acts | shear_acts), 2) << a << " " << b;
}

/// One block above is pushed along, the other is lifted off; one below is pushed the other way.
TEST(InteriorPoint, BlocksStickSlideAndLiftOffAsTheLawSays) {
  Found found(stacks({{0, 0}, {-60e3, 0}, {15e3, 0}, {0, 30e3}}));
  found.expect_law();
  EXPECT_EQ(found.count(0, 1, normal_acts | shear_acts), 2);
  EXPECT_EQ(found.count(2, 4, none_acts), 2);
  const int up = found.count(1, 3, normal_acts | at_upper), down = found.count(1, 3, normal_acts | at_lower);
  EXPECT_EQ(up + down, 2);
  EXPECT_EQ(up * down, 0);
  EXPECT_EQ(found.count(0, 2, up > 0 ? normal_acts | at_lower : normal_acts | at_upper), 2);
}

TEST(InteriorPoint, WithoutFrictionContactsAreOpenOrPressed) {
  Found found(stacks({{0, 0}, {-60e3, 0}, {15e3, 0}, {0, 30e3}}, 0));
  found.expect_law();
  for (const auto& [a, b] : {std::pair(0, 1), {0, 2}, {1, 3}}) EXPECT_EQ(found.count(a, b, normal_acts), 2);
  EXPECT_EQ(found.count(2, 4, none_acts), 2);
}

TEST(InteriorPoint, ForcesOfTheStepBeforeMayBeAllThatThereIs) {
  Scene scene = jammed(1, 0.5);
  scene.analysis.gravity.setZero();
  scene.loads.clear();
  EXPECT_TRUE(Found(scene, 1e5).obeys_law());
}

/// Where friction is large the path turns round: it is followed to its end nearly always, in steps that are
/// long where it is straight.
TEST(InteriorPoint, FollowsItsPathRoundFoldsWhereBlocksJam) {
  int n_folds = 0, n_lost = 0, round_folds = 0, straight = 0;
  constexpr int n_seeds = 60;
  for (double friction : {0.2, 1., 10., 57.})
    for (unsigned seed = 0; seed < n_seeds; ++seed) {
      Found found(jammed(seed, friction));
      const bool obeys = found.obeys_law(), folds = found.report.solutions > 60;
      n_lost += !obeys;
      n_folds += folds;
      if (obeys) (folds ? round_folds : straight) += found.report.solutions;
    }
  EXPECT_GE(n_folds, 100);
  EXPECT_LE(n_lost, 9);
  EXPECT_LE(round_folds, 210 * n_folds);
  EXPECT_LE(straight, 20 * (4 * n_seeds - n_folds));
}
