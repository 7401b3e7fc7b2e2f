#include <ddacontact/time/face_parts.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <gtest/gtest.h>

#include <map>

using namespace support;

namespace {

/// A wall of 4 m height with two smaller blocks against its right side, from 1 m to 2 m and from 2 m to 3 m.
BuiltScene wall_with_neighbours() {
  Scene scene = rock_scene(0.1, 1);
  scene.blocks = {block(rectangle(0, 0, 1, 4)), block(rectangle(1, 2, 1, 1)), block(rectangle(1, 1, 1, 1))};
  return build(scene);
}

}  // namespace

TEST(FaceParts, EdgesAreDividedWhereNeighboursBeginAndEnd) {
  const BuiltScene built = wall_with_neighbours();
  const std::vector<FacePart> parts = divide_faces(built.stepper->blocks());
  std::vector<FacePart> right;
  std::map<std::pair<int, int>, double> lengths;
  for (const FacePart& part : parts) {
    lengths[{part.face.block, part.face.edge}] += part.face.to - part.face.from;
    if (part.face.block == 0 && part.face.edge == 1) right.push_back(part);
  }
  EXPECT_EQ(lengths.size(), 12u);
  for (const auto& [edge, length] : lengths)
    EXPECT_NEAR(length, 1, 1e-12) << edge.first << ' ' << edge.second;
  ASSERT_EQ(right.size(), 4u);
  const std::vector<int> neighbours{-1, 2, 1, -1};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(right[k].face.from, 0.25 * static_cast<double>(k), 1e-12);
    EXPECT_EQ(right[k].neighbour, neighbours[k]);
  }
  const auto between = std::ranges::count_if(parts, [](const FacePart& part) { return part.neighbour >= 0; });
  EXPECT_EQ(between, 6) << "both sides of three joints";
}

TEST(FaceParts, InAJointAreThoseWhoseNeighbourIsThere) {
  BuiltScene built = wall_with_neighbours();
  BlockSystem& blocks = blocks_of(built);
  const std::vector<FacePart> parts = divide_faces(blocks);
  const auto in_joint = [](const std::vector<WetFace>& faces) {
    return std::ranges::count_if(faces, [](const WetFace& face) { return face.in_joint; });
  };
  EXPECT_EQ(in_joint(present_faces(blocks, parts)), 6);
  blocks.remove(1);
  const std::vector<WetFace> left = present_faces(blocks, parts);
  EXPECT_EQ(in_joint(left), 2) << "those between the wall and the lower block";
  for (const WetFace& face : left) EXPECT_NE(face.block, 1);
  EXPECT_EQ(left.size(), 4u + 3 + 4);
}
