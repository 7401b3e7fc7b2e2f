// Vertices that went into another block without a contact there: found, and added to the step.
#include <tests/ddacontact/simple_scenes.hpp>

using namespace support;

namespace {

/// A plate, fixed, and a block of 1 m `height` above it, near enough for a pair.
struct AboveAPlate {
  BuiltScene built;
  BlockState state;
  ContactBuilder builder;
  std::vector<Contact> contacts;

  explicit AboveAPlate(double height)
      : built(build(scene(height))),
        state(built.stepper->state()),
        builder(built.stepper->blocks(),
                {1e9, 4e8, JointTable(JointStrength{}), {0, 0}, ContactMethod::classic, 0}) {
    builder.build(state, VectorXd::Zero(state.velocity.size()), {0.5, 0.5}, {}, contacts);
  }
  static Scene scene(double height) {
    Scene scene = rock_scene(0.01, 1);
    scene.blocks = {block(rectangle(-2, -1, 6, 1), true), block(rectangle(0, height, 1, 1))};
    return scene;
  }
  bool finds_missed(const Vec2& motion) {
    BlockState end = state;
    end.position.middleCols(4, 4).colwise() += motion;
    return builder.find_missed(state, end, contacts);
  }
};

}  // namespace

TEST(MissedContacts, CornersThatGoInWithoutAContact) {
  AboveAPlate fall(0.3);
  fall.contacts.clear();
  EXPECT_FALSE(fall.finds_missed({0, -0.29}));
  EXPECT_FALSE(fall.finds_missed({0, -0.3})) << "it touches";
  ASSERT_TRUE(fall.finds_missed({0, -0.31}));
  fall.builder.add_missed(fall.state, fall.contacts);
  ASSERT_EQ(fall.contacts.size(), 2u);
  for (const Contact& contact : fall.contacts) {
    EXPECT_EQ(contact.pair.vertex_block, 1);
    EXPECT_EQ(contact.pair.edge_block, 0);
    EXPECT_EQ(contact.pair.edge, 2) << "the plate's top";
    EXPECT_EQ(contact.start_state, ContactState::open);
  }
  EXPECT_NE(fall.contacts[0].pair.vertex, fall.contacts[1].pair.vertex);
  EXPECT_FALSE(fall.finds_missed({0, -0.31})) << "what has a contact is not missed";
}

TEST(MissedContacts, ThoseAddedTwiceAreOnce) {
  AboveAPlate fall(0.3);
  fall.contacts.clear();
  ASSERT_TRUE(fall.finds_missed({0, -0.31}));
  fall.builder.add_missed(fall.state, fall.contacts);
  fall.builder.add_missed(fall.state, fall.contacts);
  EXPECT_EQ(fall.contacts.size(), 2u);
}

TEST(MissedContacts, APathBesideTheOtherBlockMissesNothing) {
  AboveAPlate fall(0.3);
  fall.contacts.clear();
  EXPECT_FALSE(fall.finds_missed({10, -0.31}));
  EXPECT_FALSE(fall.finds_missed({-8, -1.5}));
}

TEST(MissedContacts, ContactsInPlaceAreNotMissed) {
  AboveAPlate lying(0);
  ASSERT_FALSE(lying.contacts.empty());
  EXPECT_FALSE(lying.finds_missed({0, -0.01})) << "contacts hold these corners";
}
