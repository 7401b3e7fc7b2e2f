// Corners that may meet either of two lines: what a step's solution makes of them.
#include <ddacontact/contact/contacts_by_pair.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <limits>
#include <random>

using namespace support;

namespace {

constexpr double apart = 0.01;

/// Of unit squares without edges of other joints, frictionless.
ContactProperties plain_contacts(int n_blocks) {
  return {1e9,
          4e8,
          JointTable(JointStrength{}),
          std::vector<int>(static_cast<std::size_t>(n_blocks), 0),
          ContactMethod::classic,
          0};
}

/// Two towers, fixed; a beam whose lower corners are diagonally above their inner corners (block 2), one on
/// the outer corner of the first (3), and a block that lies on the second (4).
struct Towers {
  BuiltScene built;
  BlockState state;
  ContactBuilder builder;
  std::vector<double> margin = std::vector<double>(5, 0.1);

  Towers()
      : built(build(scene())),
        state(built.stepper->state()),
        builder(built.stepper->blocks(), plain_contacts(5)) {}
  static Scene scene() {
    Scene scene = rock_scene(0.1, 1);
    scene.blocks = {block(rectangle(0, 0, 1, 1), true), block(rectangle(3, 0, 1, 1), true),
                    block(rectangle(1 + apart, 1 + apart, 2 - 2 * apart, 1)),
                    block(rectangle(-1 - apart, 1 + apart, 1, 1)), block(rectangle(3.3, 1, 0.5, 0.5))};
    return scene;
  }
  /// Translations of the blocks.
  VectorXd motion(const Vec2& of_beam, const Vec2& of_other = Vec2::Zero()) const {
    VectorXd d = VectorXd::Zero(state.velocity.size());
    for (const auto& [b, by] : {std::pair{2, of_beam}, {3, of_other}}) {
      const Block& of = built.stepper->blocks().block(b);
      d.segment(of.unknowns().first, of.n_unknowns()) = of.translations() * by;
    }
    return d;
  }
  std::vector<Contact> build_with(const VectorXd& d, const std::vector<ContactRecord>& previous = {}) {
    std::vector<Contact> contacts;
    builder.build(state, d, margin, previous, contacts);
    return contacts;
  }
};

/// Whether the line of a contact is horizontal: that of an even edge of a rectangle.
bool is_flat(const Contact& contact) {
  return contact.pair.edge % 2 == 0;
}
void expect_lines(const std::vector<Contact>& contacts, const Pair& of, bool flat) {
  const auto found = of_pair(of, contacts);
  EXPECT_FALSE(found.empty());
  for (const Contact& contact : found) EXPECT_EQ(is_flat(contact), flat) << of[0] << ' ' << of[1];
}

void expect_same(const std::vector<Contact>& one, const std::vector<Contact>& other) {
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t c = 0; c < one.size(); ++c) {
    EXPECT_EQ(one[c].pair, other[c].pair);
    EXPECT_EQ(one[c].gap, other[c].gap);
    EXPECT_EQ(one[c].history.lock, other[c].history.lock);
    EXPECT_EQ(one[c].history.state, other[c].history.state);
  }
}

}  // namespace

/// Whatever motion they were built with, once chosen again they are those that the motion would have given.
TEST(ContactChoices, ChosenAgainTheyAreThoseBuiltWithTheMotion) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-2 * apart, 2 * apart);
  const auto vector = [&] { return Vec2(any(random), any(random)); };
  Towers towers, other;
  int changes = 0;
  for (int k = 0; k < 100; ++k) {
    const VectorXd before = towers.motion(vector(), vector()), after = towers.motion(vector(), vector());
    const std::vector<Contact> built = towers.build_with(before), should = other.build_with(after);
    std::vector<Contact> contacts = built;
    ASSERT_TRUE(towers.builder.has_choices());
    const bool changed = towers.builder.choose_again(towers.state, after, {}, contacts);
    expect_same(contacts, should);
    EXPECT_EQ(changed, !std::ranges::equal(built, should, {}, &Contact::pair, &Contact::pair));
    EXPECT_FALSE(towers.builder.choose_again(towers.state, after, {}, contacts));
    changes += changed;
  }
  EXPECT_GT(changes, 20);
  EXPECT_LT(changes, 100);
}

TEST(ContactChoices, TheLinePassedLastIsMet) {
  Towers towers;
  std::vector<Contact> contacts = towers.build_with(towers.motion({0, 0}));
  towers.builder.choose_again(towers.state, towers.motion({-0.012, -0.02}), {}, contacts);
  expect_lines(contacts, {0, 2}, false);
  towers.builder.choose_again(towers.state, towers.motion({-0.02, -0.012}), {}, contacts);
  expect_lines(contacts, {0, 2}, true);
}

TEST(ContactChoices, ThoseThatStayKeepWhatTheyHave) {
  Towers towers;
  std::vector<Contact> contacts = towers.build_with(towers.motion({-0.012, -0.02}, {0.012, -0.02}));
  for (std::size_t c = 0; c < contacts.size(); ++c) contacts[c].normal = 10. + static_cast<double>(c);
  const std::vector<Contact> before = contacts;
  EXPECT_TRUE(towers.builder.choose_again(towers.state, towers.motion({-0.02, -0.012}, {0.012, -0.02}), {},
                                          contacts));
  EXPECT_TRUE(std::ranges::is_sorted(contacts, {}, pair_of));
  for (const Contact& contact : contacts) {
    const auto same = std::ranges::find(before, contact.pair, &Contact::pair);
    EXPECT_EQ(contact.normal, same == before.end() ? 0 : same->normal);
  }
}

TEST(ContactChoices, InDoubtAreThosePressedWhereNothingTells) {
  Towers towers;
  std::vector<Contact> contacts = towers.build_with(towers.motion({0, 0}));
  const auto doubtful = [&](double least) { return towers.builder.find_doubtful(contacts, least, false); };
  const auto numbers_of = [&](const Pair& pair) {
    std::vector<int> numbers;
    for (const Contact& contact : contacts)
      if (pair_of(contact) == pair) numbers.push_back(static_cast<int>(&contact - contacts.data()));
    return numbers;
  };
  EXPECT_TRUE(doubtful(0).empty());
  for (Contact& contact : contacts) contact.normal = pair_of(contact) == Pair{0, 3} ? 4 : 7;
  std::vector<int> all = numbers_of({0, 2});
  std::ranges::copy(numbers_of({1, 2}), std::back_inserter(all));
  EXPECT_EQ(doubtful(4), all) << "not that of the block that lies on a tower";
  EXPECT_EQ(doubtful(3.9).size(), all.size() + numbers_of({0, 3}).size());
  EXPECT_TRUE(doubtful(7).empty());

  contacts = towers.build_with(towers.motion({-0.012, -0.02}));
  for (Contact& contact : contacts) contact.normal = 7;
  for (const int c : doubtful(0)) EXPECT_NE(pair_of(contacts[static_cast<std::size_t>(c)]), (Pair{0, 2}));
}

/// A corner that was closed on a line goes on with it, unless that is in doubt too and no bond holds it there: asked
/// once, until it slips.
TEST(ContactChoices, ThoseClosedBeforeAreInDoubtWhereAsked) {
  Scene scene = rock_scene(0.1, 1);
  scene.blocks = {block(rectangle(0, 0, 1, 1), true), block(rectangle(1, 1, 1, 1))};
  const BuiltScene built = build(scene);
  const BlockState& state = built.stepper->state();
  ContactBuilder builder(built.stepper->blocks(), plain_contacts(2));
  std::vector<Contact> contacts;
  const auto build_after = [&](const std::vector<ContactRecord>& previous) {
    builder.build(state, VectorXd::Zero(state.velocity.size()), {0.1, 0.1}, previous, contacts);
    ASSERT_EQ(contacts.size(), 1u);
    contacts[0].normal = 7;
  };
  build_after({});
  EXPECT_EQ(builder.find_doubtful(contacts, 0, false).size(), 1u) << "nothing tells";
  contacts[0].history.state = ContactState::stick;
  build_after({contacts[0]});
  EXPECT_TRUE(builder.find_doubtful(contacts, 0, false).empty());
  EXPECT_EQ(builder.find_doubtful(contacts, 0, true).size(), 1u);
  EXPECT_TRUE(builder.find_doubtful(contacts, 0, true).empty()) << "it was asked";
  contacts[0].since_asked = 1.2e-7f * static_cast<float>(contacts[0].size);
  contacts[0].law.glued = true;
  EXPECT_TRUE(builder.find_doubtful(contacts, 0, true).empty());
  contacts[0].law.glued = false;
  EXPECT_EQ(builder.find_doubtful(contacts, 0, true).size(), 1u) << "it has slipped since";
  contacts[0].since_asked = std::numeric_limits<float>::infinity();
  contacts[0].law.glued = true;
  EXPECT_TRUE(builder.find_doubtful(contacts, 0, true).empty());
}

/// For the rest of the step they are not chosen again, others are.
TEST(ContactChoices, ThoseInDoubtAreDecidedOnceByTheMotionWithoutThem) {
  Towers towers;
  for (const bool flat : {true, false}) {
    std::vector<Contact> contacts = towers.build_with(towers.motion({0, 0}, {0.012, -0.02}));
    for (Contact& contact : contacts) contact.normal = 7;
    const auto motion = [&](bool of_beam, bool of_other) {
      return towers.motion(of_beam ? Vec2(-0.02, -0.012) : Vec2(-0.012, -0.02),
                           of_other ? Vec2(0.02, -0.012) : Vec2(0.012, -0.02));
    };
    expect_lines(contacts, {0, 3}, false);
    const std::vector<Contact> before = contacts;
    ASSERT_FALSE(towers.builder.find_doubtful(contacts, 0, false).empty());
    const bool changed = towers.builder.decide_doubtful(towers.state, motion(flat, true), {}, contacts);
    EXPECT_EQ(changed, !std::ranges::equal(before, contacts, {}, &Contact::pair, &Contact::pair));
    expect_lines(contacts, {0, 2}, flat);
    expect_lines(contacts, {0, 3}, false);
    EXPECT_TRUE(towers.builder.choose_again(towers.state, motion(!flat, true), {}, contacts));
    expect_lines(contacts, {0, 2}, flat);
    expect_lines(contacts, {0, 3}, true);
  }
}
