#include <ddacontact/detection/nearby_pairs.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

using namespace ddacontact;
using support::uniform;

namespace {

constexpr int n_boxes = 200;

std::vector<Box> random_boxes(std::mt19937& random) {
  std::vector<Box> boxes;
  for (int b = 0; b < n_boxes; ++b) {
    const Vec2 low(uniform(0, 10, random), uniform(0, 10, random));
    boxes.push_back({low, low + Vec2(uniform(0.1, 2, random), uniform(0.1, 2, random))});
  }
  return boxes;
}

void move(Box& box, const Vec2& by) {
  box.low += by;
  box.high += by;
}

std::vector<Pair> found_by(NearbyPairs& nearby, const std::vector<Box>& boxes,
                           const std::vector<double>& margins) {
  std::vector<Pair> pairs;
  nearby.find(boxes, margins, pairs);
  return pairs;
}

}  // namespace

/// However boxes move, the pairs and their order are those of a new search; slow ones need few.
TEST(NearbyPairs, AreThoseOfASearchAtEveryStep) {
  for (const double speed : {0.001, 0.01, 0.5}) {
    std::mt19937 random(3);
    std::vector<Box> boxes = random_boxes(random);
    const std::vector<double> margins(n_boxes, 0.05);
    NearbyPairs nearby;
    for (int step = 0; step < 100; ++step) {
      for (Box& box : boxes) move(box, speed * Vec2(uniform(-1, 1, random), uniform(-1, 1, random)));
      ASSERT_EQ(found_by(nearby, boxes, margins), overlapping_pairs(boxes));
    }
    const int most = speed == 0.001 ? 3 : 100;
    EXPECT_LE(nearby.n_searches(), most);
  }
}

TEST(NearbyPairs, AreLookedForOnceWhileBoxesStayWithinTheirMargins) {
  std::mt19937 random(4);
  const std::vector<Box> start = random_boxes(random);
  const std::vector<double> margins(n_boxes, 0.05);
  NearbyPairs nearby;
  for (int step = 0; step < 20; ++step) {
    std::vector<Box> boxes = start;
    for (Box& box : boxes) move(box, Vec2(uniform(-0.05, 0.05, random), uniform(-0.05, 0.05, random)));
    if (step == 0) boxes = start;
    EXPECT_EQ(found_by(nearby, boxes, margins), overlapping_pairs(boxes));
  }
  EXPECT_EQ(nearby.n_searches(), 1);
  std::vector<Box> boxes = start;
  move(boxes[7], Vec2(0.0501, 0));
  EXPECT_EQ(found_by(nearby, boxes, margins), overlapping_pairs(boxes));
  EXPECT_EQ(nearby.n_searches(), 2);
}

TEST(NearbyPairs, AreLookedForEachTimeWithoutMargins) {
  std::mt19937 random(5);
  const std::vector<Box> boxes = random_boxes(random);
  NearbyPairs nearby;
  for (int step = 0; step < 3; ++step) EXPECT_EQ(found_by(nearby, boxes, {}), overlapping_pairs(boxes));
  EXPECT_EQ(nearby.n_searches(), 3);
}
