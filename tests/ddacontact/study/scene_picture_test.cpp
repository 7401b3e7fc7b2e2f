#include "../simple_scenes.hpp"

#include <ddacontact/study/scene_picture.hpp>

#include <pugixml.hpp>

namespace {

using namespace support;

/// Two bricks of two materials on a base, the one above the joint of the others.
Scene bricks() {
  Scene scene;
  scene.materials = {{"rock", 2500, 1e9, 0.2}, {"brick", 2000, 1e9, 0.2}};
  scene.joints = {{"general", 30, 0, 0, std::nullopt}, {"bed", 35, 0, 0, std::array{0, 1}}};
  scene.blocks = {block(rectangle(0, -1, 4, 1), true), block(rectangle(0, 0, 1, 1)),
                  block(rectangle(1, 0, 2, 1))};
  scene.blocks[1].material = scene.blocks[2].material = 1;
  scene.blocks[1].name = "left<";
  return scene;
}

int count(const std::string& text, const std::string& word) {
  int n = 0;
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += word.size()) ++n;
  return n;
}

TEST(ScenePicture, KnowsTheJointOfEachSharedFace) {
  const std::vector<SharedFace> faces = shared_faces(bricks());
  ASSERT_EQ(faces.size(), 3u);
  double bed = 0, head = 0;
  for (const SharedFace& face : faces) (face.joint == 1 ? bed : head) += (face.to - face.from).norm();
  EXPECT_DOUBLE_EQ(bed, 3);
  EXPECT_DOUBLE_EQ(head, 1);
}

TEST(ScenePicture, TheJointOfAnEdgeGoesBeforeThatOfTheMaterials) {
  Scene scene = bricks();
  scene.blocks[1].edge_joints = {-1, 1, -1, -1};
  for (const SharedFace& face : shared_faces(scene)) EXPECT_EQ(face.joint, 1);
}

/// Neither an edge nor the materials have a joint: the first holds, as for contacts.
TEST(ScenePicture, FallsBackOnTheFirstJoint) {
  Scene scene = bricks();
  scene.joints[0].between = std::array{0, 0};
  const std::vector<SharedFace> faces = shared_faces(scene);
  ASSERT_EQ(faces.size(), 3u);
  EXPECT_EQ(std::ranges::count(faces, 0, &SharedFace::joint), 1);
}

TEST(ScenePicture, BlocksApartShareNoFace) {
  Scene scene = bricks();
  scene.blocks[2].vertices.row(0).array() += 1e-3;
  EXPECT_EQ(shared_faces(scene).size(), 2u);
}

TEST(ScenePicture, ShowsNamesNumbersLoadsAndMonitors) {
  Scene scene = bricks();
  scene.loads = {pressure_load(1, 2, 5), point_load(2, Vec2(2, 1), constant(Vec2(0, -3)))};
  scene.monitors = {{"corner", 2, Monitor::Kind::vertex, Vec2(0, 0), 2}};
  const std::string plain = draw(scene, {}), full = draw(scene, {.names = true, .numbers = true});
  for (const std::string& picture : {plain, full})
    EXPECT_TRUE(pugi::xml_document().load_string(picture.c_str()));
  EXPECT_EQ(plain.find("left"), std::string::npos);
  EXPECT_NE(full.find(">left&lt;<"), std::string::npos);
  EXPECT_NE(full.find(">corner<"), std::string::npos);
  EXPECT_EQ(count(full, ">e3<"), 3);
  EXPECT_EQ(count(plain, ">e3<"), 0);
  EXPECT_NE(plain.find("joint bed"), std::string::npos);
  EXPECT_NE(plain.find(">load<"), std::string::npos);
  EXPECT_NE(plain.find(">held<"), std::string::npos);
}

TEST(ScenePicture, IsOfBlocks) {
  EXPECT_THROW(draw(Scene(), {}), Error);
}

}  // namespace
