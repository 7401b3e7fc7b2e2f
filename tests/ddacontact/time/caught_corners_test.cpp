#include <ddacontact/time/caught_corners.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <gtest/gtest.h>

using namespace support;

namespace {

/// A block of which corner 1 comes to a seam between two plates of 3 m and 1 m, the second of which is higher
/// by a step; at the start by another one.
struct AtASeam {
  BuiltScene built;
  BlockState state;
  std::vector<Contact> contacts{2};

  explicit AtASeam(double step, double at_start = 0)
      : built(build(scene(at_start))), state(built.stepper->state()) {
    const Range& second = built.stepper->blocks().block(1).vertices();
    state.position.middleCols(second.first, second.count).row(1).array() += step - at_start;
    contacts[0].pair = {2, 1, 0, 2};  // it bears on the first plate
    contacts[1].pair = {2, 1, 1, 3};  // and is pressed against the side of the second
    for (Contact& contact : contacts) {
      contact.normal = 1e3;
      contact.size = 1;
    }
  }
  static Scene scene(double at_start) {
    Scene scene = rock_scene(0.1, 1);
    scene.blocks = {block(rectangle(0, -1, 3, 1)), block(rectangle(3, -1 + at_start, 1, 1)),
                    block(rectangle(1, 0, 2, 1))};
    return scene;
  }
  int caught() const { return find_caught_block(built.stepper->blocks(), state, contacts); }
};

}  // namespace

TEST(CaughtCorners, AreThoseAtAStepTooLowToSeeThatWasNotThereAtTheStart) {
  EXPECT_EQ(AtASeam(0.005).caught(), 2);
  EXPECT_EQ(AtASeam(0.0099).caught(), 2);
  EXPECT_EQ(AtASeam(0.011).caught(), -1) << "seen in a picture";
  EXPECT_EQ(AtASeam(0.5e-4).caught(), -1) << "flush";
  EXPECT_EQ(AtASeam(0).caught(), -1);
  EXPECT_EQ(AtASeam(-0.005).caught(), -1) << "downwards";
  EXPECT_EQ(AtASeam(0.005, 0.004).caught(), -1) << "it was drawn so";
}

TEST(CaughtCorners, BearOnOneBlockAndArePressedAgainstTheOther) {
  AtASeam free(0.005);
  free.contacts[1].normal = 0;
  EXPECT_EQ(free.caught(), -1);
  free.contacts[1].normal = 1e3;
  free.contacts[0].normal = 0;
  EXPECT_EQ(free.caught(), -1);
  free.contacts[0].start_state = ContactState::stick;
  EXPECT_EQ(free.caught(), 2) << "it bore there at the start of the step";
  free.contacts.pop_back();
  EXPECT_EQ(free.caught(), -1);
  AtASeam same(0.005);
  same.contacts[0].pair = {2, 1, 1, 2};  // both sides of one block
  EXPECT_EQ(same.caught(), -1);
}
