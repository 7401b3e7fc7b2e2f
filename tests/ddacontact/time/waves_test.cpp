#include <ddacontact/time/waves.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <gtest/gtest.h>

using namespace support;

/// lambda + 2 mu of 1e8 Pa and 0.25 is 1.2e8 Pa, and the speed of waves its root over that of 2000 kg/m3.
TEST(Waves, StepsCarryThemWhileShorterThanTheWayThroughEitherBlock) {
  Scene scene = rock_scene(0.1, 1);
  scene.blocks = {block(rectangle(0, 0, 3, 3)), block(rectangle(5, 0, 8, 0.5)),
                  block(rectangle(20, 0, 0.1, 0.1), true)};
  const BuiltScene built = build(scene);
  const BlockSystem& blocks = built.stepper->blocks();
  const double speed = std::sqrt(1.2e8 / 2000);
  EXPECT_NEAR(transit_time(blocks.block(0)), 3 / speed, 1e-14);
  EXPECT_NEAR(transit_time(blocks.block(1)), 2 / speed, 1e-14);
  Contact contact;
  for (const auto& [a, b] : {std::pair{0, 1}, {1, 0}}) {
    contact.pair = {a, 0, b, 0};
    EXPECT_TRUE(carries_waves(blocks, contact, 1.99 / speed));
    EXPECT_FALSE(carries_waves(blocks, contact, 2.01 / speed));
  }
  contact.pair = {2, 0, 0, 0};  // through a held block no wave has to go
  EXPECT_TRUE(carries_waves(blocks, contact, 2.99 / speed));
  EXPECT_FALSE(carries_waves(blocks, contact, 3.01 / speed));
}
