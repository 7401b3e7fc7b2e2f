#include <ddacontact/contact/contact_builder.hpp>
#include <tests/ddacontact/simple_scenes.hpp>
#include <tests/support/concave_polygons.hpp>

#include <gtest/gtest.h>

using namespace support;

namespace {

/// The contacts at the start between a plate and a block.
struct Faces {
  BuiltScene built;
  std::vector<Contact> contacts;

  Faces(const Points& plate, const Points& upper, const JointStrength& joint,
        const std::vector<Support>& supports = {}, const std::vector<std::vector<int>>& edge_joints = {})
      : built(build(scene(plate, upper, supports))) {
    ContactProperties properties{
        1e9, 4e8, JointTable({{joint, std::nullopt}, {{0.9}, {{5, 5}}}}), {0, 0}, ContactMethod::classic, 0};
    properties.edge_joints = edge_joints;
    const BlockState& state = built.stepper->state();
    contacts = ContactBuilder(built.stepper->blocks(), properties)
                   .build_first(state, VectorXd::Zero(state.velocity.size()), {0.1, 0.1});
  }
  static Scene scene(const Points& plate, const Points& upper, const std::vector<Support>& supports) {
    Scene scene = rock_scene(0.1, 1);
    scene.blocks = {block(plate, true), block(upper)};
    scene.blocks[0].model = BlockModel::mean_value;
    scene.supports = supports;
    return scene;
  }
  double length() const {
    double sum = 0;
    for (const Contact& contact : contacts) sum += contact.history.length;
    return sum;
  }
  const Contact* of_vertex(int vertex) const {
    const auto found = std::ranges::find_if(contacts, [&](const Contact& contact) {
      return contact.pair.vertex_block == 1 && contact.pair.vertex == vertex;
    });
    return found == contacts.end() ? nullptr : &*found;
  }
};

const JointStrength soft{.friction = 0.5, .normal_stiffness = 1e9, .shear_stiffness = 4e8};

}  // namespace

/// Also with nodes along the faces, and where corners lie a little apart.
TEST(ContactPlaces, LengthsAddUpToTheOverlapOfTheFaces) {
  const Points plate = points({{0, -1}, {3, -1}, {3, 0}, {1, 0}, {0, 0}});
  for (const JointStrength& joint : {JointStrength{0.5}, soft})
    for (const double x : {-0.5, 0., 0.004, 0.3, 0.9, 1.5}) {
      const Faces faces(plate, rectangle(x, 0, 2, 1), joint);
      EXPECT_NEAR(faces.length(), std::min(3., x + 2) - std::max(0., x), 1e-9) << x;
    }
}

/// Of two corners nearer than a hundredth of the edge each is over the other's face: one contact stands
/// there.
TEST(ContactPlaces, OneContactStandsWhereTwoVerticesMeet) {
  for (const double shift : {0., 0.005, -0.005, 0.02})
    EXPECT_EQ(Faces(rectangle(0, -1, 1, 1), rectangle(shift, 0, 1, 1), soft).contacts.size(), 2u) << shift;
  for (const double shift : {0.005, 0.02}) {  // a node of the plate under the block's corner
    const Points plate = points({{0, -1}, {3, -1}, {3, 0}, {1 + shift, 0}, {0, 0}});
    EXPECT_EQ(Faces(plate, rectangle(1, 0, 1, 1), soft).contacts.size(), shift < 0.01 ? 2u : 3u) << shift;
  }
}

/// Where nothing but supports decides over gap and slip there is nothing to solve.
TEST(ContactPlaces, AVertexThatIsHeldHasNoContact) {
  const Points plate = rectangle(-1, -1, 4, 1), upper = rectangle(0, 0, 1, 1);
  const JointStrength bonded{0.5, 1e4, 1e4};
  EXPECT_TRUE(Faces(plate, upper, bonded).of_vertex(0));
  const Faces held(plate, upper, bonded, {{1, {0}, true, true, {}}});
  EXPECT_FALSE(held.of_vertex(0));
  ASSERT_TRUE(held.of_vertex(1));
  EXPECT_EQ(held.of_vertex(1)->law.friction, 0.5);
  // Held upwards alone it may slide: a bond bears that, but friction is not known.
  const Faces rolls(plate, upper, bonded, {{1, {0}, false, true, {}}});
  ASSERT_TRUE(rolls.of_vertex(0));
  EXPECT_EQ(rolls.of_vertex(0)->law.friction, 0);
  EXPECT_GT(rolls.of_vertex(0)->law.cohesion, 0);
  EXPECT_FALSE(Faces(plate, upper, {0.5}, {{1, {0}, false, true, {}}}).of_vertex(0)) << "without a bond";
  EXPECT_TRUE(Faces(plate, upper, {0.5}, {{1, {0}, true, false, {}}}).of_vertex(0)) << "it may lift off";
}

/// The length of a corner lies beyond the end of its edge, on another joint.
TEST(ContactPlaces, ThePartOnTheNextJointIsToldByItsSide) {
  const Points plate = points({{0, -1}, {4, -1}, {4, 0}, {2, 0}, {0, 0}});
  const std::vector<std::vector<int>> joints{{-1, -1, 0, 1}, {-1, -1, -1, -1}},
      one_joint{{-1, -1, 1, 1}, {-1, -1, -1, -1}};
  const Faces faces(plate, rectangle(1.75, 0, 2, 1), {0.3}, {}, joints);  // from edge 3 over edge 2
  ASSERT_TRUE(faces.of_vertex(0));
  EXPECT_NEAR(faces.of_vertex(0)->history.length_beyond, -faces.of_vertex(0)->history.length, 1e-7);
  EXPECT_DOUBLE_EQ(faces.of_vertex(0)->law.friction, 0.3);
  EXPECT_EQ(faces.of_vertex(1)->history.length_beyond, 0);
  const Faces to_left(plate, rectangle(0.25, 0, 2, 1), {0.3}, {}, joints);
  ASSERT_TRUE(to_left.of_vertex(1));
  EXPECT_NEAR(to_left.of_vertex(1)->history.length_beyond, to_left.of_vertex(1)->history.length, 1e-7);
  EXPECT_DOUBLE_EQ(to_left.of_vertex(1)->law.friction, 0.9);
  EXPECT_EQ(Faces(plate, rectangle(1.75, 0, 2, 1), {0.3}, {}, one_joint).of_vertex(0)->history.length_beyond,
            0);
}
