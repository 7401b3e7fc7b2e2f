#include <ddacontact/contact/contact_builder.hpp>
#include <polyfem/core/parallel.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <gtest/gtest.h>

using namespace support;
using enum ContactState;

namespace {

JointTable one_joint(const JointStrength& strength) {
  return JointTable(strength);
}

/// A block on a wider fixed one, shifted against the place where their edges just touch.
struct BlockOnPlate {
  BuiltScene built;
  ContactBuilder builder;
  BlockState state;
  std::vector<double> search_margin{0.1, 0.1};

  explicit BlockOnPlate(double shift_x, double shift_y, double friction = 0.5, double width = 1)
      : built(build(scene(shift_x, shift_y, width))),
        builder(built.stepper->blocks(), properties(friction)),
        state(built.stepper->state()) {}
  static Scene scene(double shift_x, double shift_y, double width) {
    Scene s = rock_scene(0.1, 1);
    s.blocks = {block(rectangle(0, -1, 3, 1), true), block(rectangle(1 + shift_x, shift_y, width, 1))};
    return s;
  }
  static ContactProperties properties(double friction, int n_blocks = 2) {
    return {1e9,
            4e8,
            one_joint({friction, 7e3, 5e3}),
            std::vector<int>(static_cast<std::size_t>(n_blocks), 0),
            ContactMethod::classic,
            0};
  }
  VectorXd at_rest() const { return VectorXd::Zero(state.velocity.size()); }
  void move(const Vec2& by) { state.position.rightCols<4>().colwise() += by; }
  std::vector<Contact> first() { return builder.build_first(state, at_rest(), search_margin); }
  std::vector<Contact> after(const std::vector<Contact>& previous) {
    std::vector<Contact> contacts;
    builder.build(state, at_rest(), search_margin, {previous.begin(), previous.end()}, contacts);
    return contacts;
  }
};

}  // namespace

TEST(ContactBuilder, TouchingContactsBeginBondedAndOverlapsAreFreeOfStress) {
  for (double overlap : {0., -5e-4, 5e-7}) {
    const auto contacts = BlockOnPlate(0, overlap).first();
    ASSERT_EQ(contacts.size(), 2u);
    for (const Contact& c : contacts) {
      EXPECT_EQ(c.history.state, stick);
      EXPECT_TRUE(c.history.bonded);
      EXPECT_NEAR(c.history.gap_offset, std::min(overlap, 0.), 1e-14);
      EXPECT_DOUBLE_EQ(c.history.length, 0.5);
      EXPECT_DOUBLE_EQ(c.law.cohesion, 3.5e3);
      EXPECT_DOUBLE_EQ(c.law.tension, 2.5e3);
      EXPECT_NEAR(c.first_slip().constant, 0, 1e-14);
    }
  }
}

TEST(ContactBuilder, ContactsApartBeginOpenAndWithoutABond) {
  const auto contacts = BlockOnPlate(0, 0.01).first();
  ASSERT_EQ(contacts.size(), 2u);
  for (const Contact& c : contacts) {
    EXPECT_EQ(c.history.state, open);
    EXPECT_FALSE(c.history.bonded);
    EXPECT_EQ(c.law.cohesion, 0);
    EXPECT_EQ(c.law.tension, 0);
  }
}

TEST(ContactBuilder, StickingContactsKeepTheirLockPointAndSlidingOnesMoveIt) {
  for (ContactState before : {stick, slip_forward}) {
    BlockOnPlate pair(0, 0);
    auto previous = pair.first();
    for (Contact& c : previous) c.history.state = before;
    pair.move({0.01, -1e-5});
    const auto contacts = pair.after(previous);
    ASSERT_EQ(contacts.size(), 2u);
    for (std::size_t c = 0; c < 2; ++c) {
      EXPECT_EQ(contacts[c].history.state, before);
      EXPECT_NEAR(contacts[c].gap, -1e-5, 1e-14);
      // The fixed block's upper edge runs from right to left.
      EXPECT_NEAR(contacts[c].first_slip().constant, before == stick ? -0.01 : 0, 1e-14);
      EXPECT_EQ(contacts[c].history.bonded, previous[c].history.bonded);
      EXPECT_EQ(contacts[c].law.cohesion, previous[c].law.cohesion);
    }
  }
}

TEST(ContactBuilder, AnOpenContactThatIsPenetratedAtDetectionBeginsClosed) {
  BlockOnPlate pair(0, 0.01);
  const auto previous = pair.first();
  pair.move({0, -0.011});
  for (const Contact& c : pair.after(previous)) {
    EXPECT_EQ(c.history.state, stick);
    EXPECT_FALSE(c.history.bonded);
    EXPECT_EQ(c.history.gap_offset, 0);
  }
}

/// Corners slide past each other: the contact goes from one block's vertex to the other's, with its spring's
/// length.
TEST(ContactBuilder, AContactHandedOverAtACornerKeepsItsSlip) {
  for (double way : {-1., 1.}) {
    // Two metres on three, a millimetre within the end that it slides over.
    BlockOnPlate pair(way > 0 ? -1e-3 : -1 + 1e-3, 0, 0.5, 2);
    auto previous = pair.first();
    ASSERT_EQ(previous.size(), 2u);
    for (Contact& c : previous) c.end_slip = 2e-4;
    pair.move({way * 2e-3, -1e-5});
    const auto contacts = pair.after(previous);
    ASSERT_EQ(contacts.size(), 2u);
    int handed_over = 0;
    for (const Contact& c : contacts) {
      const bool same =
          std::any_of(previous.begin(), previous.end(), [&](const Contact& p) { return p.pair == c.pair; });
      if (same) continue;
      ++handed_over;
      EXPECT_EQ(c.history.state, stick);
      EXPECT_NEAR(c.first_slip().constant, 2e-4, 1e-12);
    }
    EXPECT_EQ(handed_over, 1);
  }
}

/// A sticking corner that slides past a vertex on a straight side keeps its slip and its bond.
TEST(ContactBuilder, AContactGoesStraightOnToTheNextEdge) {
  Scene scene = rock_scene(0.1, 1);
  Points plate(2, 5);
  plate << 0, 3, 3, 1.05, 0, -1, -1, 0, 0, 0;
  scene.blocks = {block(plate, true), block(rectangle(1, 0, 1, 1))};
  scene.blocks[0].model = scene.blocks[1].model = BlockModel::affine;
  const BuiltScene built = build(scene);
  ContactBuilder builder(built.stepper->blocks(), BlockOnPlate::properties(0.5));
  BlockState state = built.stepper->state();
  std::vector<Contact> contacts = builder.build_first(state, state.velocity, {0.1, 0.1});
  const auto corner = [](const std::vector<Contact>& of) {
    return *std::find_if(of.begin(), of.end(),
                         [](const Contact& c) { return c.pair.vertex_block == 1 && c.pair.vertex == 0; });
  };
  ASSERT_EQ(corner(contacts).pair.edge, 3);
  ASSERT_TRUE(corner(contacts).history.bonded);
  for (Contact& c : contacts) c.end_slip = 0.1;
  state.position.rightCols<4>().row(0).array() += 0.1;
  std::vector<Contact> later;
  builder.build(state, state.velocity, {0.1, 0.1}, {contacts.begin(), contacts.end()}, later);
  const Contact moved = corner(later);
  EXPECT_EQ(moved.pair.edge, 2);
  EXPECT_EQ(moved.history.state, corner(contacts).history.state);
  EXPECT_TRUE(moved.history.bonded);
  EXPECT_EQ(moved.history.length, corner(contacts).history.length);
  EXPECT_NEAR(moved.first_slip().constant, corner(contacts).end_slip, 1e-12);
}

/// A wall: the same contacts, in their order, for any number of threads and with or without the margin that
/// pairs are kept with, which are looked for once while it rests.
TEST(ContactBuilder, ARestingWallIsSearchedOnce) {
  Scene scene = rock_scene(0.1, 1);
  scene.blocks = {block(rectangle(-1, -1, 40, 1), true)};
  for (int row = 0; row < 20; ++row)
    for (int k = 0; k < 30; ++k) scene.blocks.push_back(block(rectangle(k + 0.5 * (row % 2), row, 1, 1)));
  const BuiltScene built = build(scene);
  BlockState state = built.stepper->state();
  const std::vector<double> search_margin(scene.blocks.size(), 0.02);
  const ContactProperties properties = BlockOnPlate::properties(0.5, built.stepper->blocks().n_blocks());
  ContactBuilder kept(built.stepper->blocks(), properties), searched(built.stepper->blocks(), properties);
  searched.keep_pairs(false);
  std::vector<Contact> by_kept = kept.build_first(state, state.velocity, search_margin), by_searched;
  for (int step = 0; step < 6; ++step) {
    const std::vector<ContactRecord> before(by_kept.begin(), by_kept.end());
    state.position += 1e-3 * Points::Random(2, state.position.cols());
    polyfem::set_threads(1 + step % 3);
    kept.build(state, state.velocity, search_margin, before, by_kept);
    polyfem::set_threads(1);
    searched.build(state, state.velocity, search_margin, before, by_searched);
    ASSERT_EQ(by_kept.size(), by_searched.size());
    for (std::size_t c = 0; c < by_kept.size(); ++c) {
      const Contact &p = by_kept[c], &q = by_searched[c];
      ASSERT_EQ(p.pair, q.pair);
      EXPECT_EQ(p.history.state, q.history.state);
      EXPECT_EQ(p.history.lock, q.history.lock);
      EXPECT_EQ(p.gap, q.gap);
      EXPECT_EQ(p.first_slip().constant, q.first_slip().constant);
    }
  }
  EXPECT_EQ(kept.n_searches(), 1);
  EXPECT_EQ(searched.n_searches(), 6);
}

TEST(ContactBuilder, HeldBlocksDoNotCountForTheSizeOfAPair) {
  Scene scene = rock_scene(0.1, 1);
  scene.blocks = {block(rectangle(0, -1, 0.1, 0.1), true), block(rectangle(3, 0, 4, 4)),
                  block(rectangle(9, 0, 2, 2))};
  const BuiltScene built = build(scene);
  const ContactBuilder builder(built.stepper->blocks(), {1e9, 4e8, one_joint({}), {0, 0, 0}});
  EXPECT_DOUBLE_EQ(builder.pair_size(0, 1), 4);
  EXPECT_DOUBLE_EQ(builder.pair_size(1, 0), 4);
  EXPECT_DOUBLE_EQ(builder.pair_size(1, 2), 2);
}

TEST(ContactBuilder, TwoHeldBlocksDoNotMeet) {
  Scene scene = rock_scene(0.1, 1);
  scene.blocks = {block(rectangle(0, 0, 1, 1), true), block(rectangle(1, 0, 1, 1), true)};
  EXPECT_TRUE(build(scene).stepper->contacts().empty());
}
