#include <ddacontact/time/islands.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <gtest/gtest.h>

using namespace support;

namespace {

/// Block 0 is held, four others are not; nothing touches.
struct FiveBlocks {
  BuiltScene built;
  Islands islands;

  FiveBlocks() : built(build(scene())), islands(built.stepper->blocks()) {}
  static Scene scene() {
    Scene scene = rock_scene(0.1, 1);
    for (int k = 0; k < 5; ++k) scene.blocks.push_back(block(rectangle(2 * k, 0, 1, 1), k == 0));
    return scene;
  }
  /// A form that depends on a vertex of each of these.
  AffineForm form(std::initializer_list<int> of) const {
    AffineForm form;
    for (const int b : of) built.stepper->blocks().block(b).vertex_map(1).add_to(form, {1, 2});
    return form;
  }
};

}  // namespace

TEST(Islands, HeldBlocksDoNotPassImpulsesOn) {
  FiveBlocks five;
  five.islands.join(0, 1);
  five.islands.join(2, 0);
  EXPECT_NE(five.islands.root(1), five.islands.root(2));
  five.islands.join(1, 2);
  five.islands.join(five.form({0, 2, 4}));
  EXPECT_EQ(five.islands.root(1), five.islands.root(4));
  EXPECT_NE(five.islands.root(3), five.islands.root(1));
  EXPECT_NE(five.islands.root(0), five.islands.root(1));
}

TEST(Islands, AllBlocksOfOneThatIsHitTakePart) {
  FiveBlocks five;
  five.islands.join(4, 1);
  five.islands.hit(five.form({0}));
  EXPECT_TRUE(five.islands.hit_blocks().empty()) << "a held block is hit";
  five.islands.hit(five.form({0, 4}));
  EXPECT_EQ(five.islands.hit_blocks(), (std::vector<int>{1, 4}));
  EXPECT_TRUE(five.islands.is_hit(five.form({1})));
  EXPECT_TRUE(five.islands.is_hit(five.form({0, 1})));
  EXPECT_FALSE(five.islands.is_hit(five.form({2})));
  EXPECT_FALSE(five.islands.is_hit(five.form({0})));
}
