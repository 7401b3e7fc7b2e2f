/// \file Scenes and geometry files changed at random: reading them ends, with a valid scene or with problems.
#include "geometry_scenes.hpp"
#include "mutator.hpp"

#include <ddacontact/scene/block_cutting.hpp>
#include <ddacontact/scene/outline_check.hpp>
#include <ddacontact/scene/writer.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/validity.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <sstream>

namespace {

using namespace geometry_scenes;
using support::Mutator;
using namespace ddacontact;

constexpr std::string_view moving = R"(title = "Moving" # ...
analysis = { steps = 2, time_step = "10 ms", mode = "static", preset = "paper", damping = { mass = 1, stiffness = "1 ms" } }
material = [ { name = "a", density = 1, young = 1, poisson = 0 } ]
[[block]]
name = 'one'
material = 'a'
vertices = [[0, 0], [0, 1], [1, 1], [1, 0]] # clockwise
fixed = true
[[block]]
material = "a"
vertices = [["1 m", 0], [2, 0], [1.5, 1e0]]
stress = ["1 kPa", 0, 0]
[[load]]
type = "body"
block = 1
history = [[0, 0, 0], ["1 s", "1 kN/m3", 0]]
[[monitor]]
name = "m"
block = "one"
vertex = 0
)";

constexpr std::string_view shapes = R"(
[analysis]
steps = 2
time_step = 0.01
block_model = "mean_value"
mesh = { cell_size = "20 cm", edge_nodes = false }
[[material]]
name = "a"
density = 1
young = 1
poisson = 0
[[block]]
name = "L"
material = "a"
vertices = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]]
model = "mesh"
[[block]]
name = "square with a middle"
material = "a"
vertices = [[1, 1], [2, 1], [2, 1.5], [2, 2], [1, 2]]
mesh = { cells = 16 }
[[block]]
material = "a"
vertices = [[3, 0], [5, 0], [5, 2], [3, 2]]
model = "mesh"
mesh = { kind = "quads", cells = 9, edge_nodes = true }
[[block]]
material = "a"
vertices = [[0, -1], [0, -2], [2, -2], [0.5, -1.5]]
model = "auto"
fixed = [3]
[[load]]
type = "point"
block = "L"
at = [0.5, 1.5]
force = [1, 0]
)";

void expect_sound(const Scene& scene, const std::string& text) {
  const auto finite = [&](double value) { EXPECT_TRUE(std::isfinite(value)) << text; };
  finite(scene.analysis.time_step);
  finite(scene.analysis.gravity.norm());
  finite(scene.contact.normal_stiffness);
  finite(scene.contact.tangential_stiffness);
  EXPECT_GT(scene.contact.normal_stiffness, 0) << text;
  EXPECT_GT(scene.contact.tangential_stiffness, 0) << text;
  EXPECT_GE(scene.analysis.steps, 1) << text;
  EXPECT_GT(scene.analysis.time_step, 0) << text;
  EXPECT_FALSE(scene.joints.empty());
  EXPECT_FALSE(scene.blocks.empty());
  for (const Material& material : scene.materials) {
    finite(material.density);
    EXPECT_GT(material.density, 0) << text;
    EXPECT_GT(material.young, 0) << text;
    EXPECT_TRUE(material.poisson >= 0 && material.poisson < 0.5) << text;
  }
  const int n_materials = static_cast<int>(scene.materials.size()),
            n_blocks = static_cast<int>(scene.blocks.size());
  for (const BlockDescription& block : scene.blocks) {
    scene_format::ProblemList problems("block");
    scene_format::Outline outline;
    outline.points = block.vertices;
    outline.locations.resize(block.vertices.cols());
    EXPECT_TRUE(scene_format::check_outline(outline, block.model, {}, "block", problems).valid()) << text;
    EXPECT_TRUE(block.material >= 0 && block.material < n_materials) << text;
    EXPECT_TRUE(block.mesh.cells >= 1 && block.mesh.cells <= scene_format::most_cells) << text;
    EXPECT_GE(block.mesh.cell_size, 0) << text;
    finite(block.mesh.cell_size);
    if (block.model == BlockModel::mesh) {
      EXPECT_EQ(scene.analysis.kinematics, Kinematics::corotational) << text;
      EXPECT_TRUE(block.mesh.kind != CellKind::quads || block.vertices.cols() == 4) << text;
    }
    for (const int k : block.fixed_vertices) EXPECT_TRUE(k >= 0 && k < block.vertices.cols()) << text;
    finite(block.velocity.norm());
    finite(block.angular_velocity);
    finite(block.stress.norm());
  }
  for (const Support& support : scene.supports) {
    ASSERT_TRUE(support.block >= 0 && support.block < n_blocks) << text;
    for (const int k : support.vertices)
      EXPECT_TRUE(k >= 0 && k < scene.blocks[support.block].vertices.cols()) << text;
    finite(support.displacement.at(0.5, scene.end_time()).norm());
  }
  for (const Load& load : scene.loads) {
    ASSERT_TRUE(load.block >= 0 && load.block < n_blocks) << text;
    EXPECT_TRUE(load.edge >= 0 && load.edge < scene.blocks[load.block].vertices.cols()) << text;
    finite(load.force.at(0.5, scene.end_time()).norm());
  }
  EXPECT_GT(scene.end_time(), 0) << text;
  std::vector<bool> is_gone(scene.blocks.size(), false);
  for (const StageDescription& stage : scene.stages) {
    EXPECT_GE(stage.analysis.steps, 1) << text;
    EXPECT_GT(stage.analysis.time_step, 0) << text;
    EXPECT_EQ(stage.analysis.kinematics, scene.analysis.kinematics) << text;
    EXPECT_EQ(stage.joints.size(), scene.joints.size()) << text;
    for (const Joint& joint : stage.joints)
      EXPECT_TRUE(joint.friction_angle >= 0 && joint.friction_angle < 90) << text;
    for (const int block : stage.removed) {
      ASSERT_TRUE(block >= 0 && block < n_blocks) << text;
      EXPECT_FALSE(is_gone[block]) << text;
      is_gone[block] = true;
    }
    EXPECT_LT(std::count(is_gone.begin(), is_gone.end(), true), n_blocks) << text;
  }
  for (const Monitor& monitor : scene.monitors) {
    ASSERT_TRUE(monitor.block >= 0 && monitor.block < n_blocks) << text;
    EXPECT_TRUE(monitor.vertex >= 0 && monitor.vertex < scene.blocks[monitor.block].vertices.cols()) << text;
  }
}

/// The number of mutants of each scene: from SCENE_FUZZ in the environment, else a few seconds' worth.
unsigned n_mutants() {
  const char* wanted = std::getenv("SCENE_FUZZ");
  return wanted ? static_cast<unsigned>(std::strtoul(wanted, nullptr, 10)) : 4000;
}

/// Whatever can be read can be cut into convex blocks that fill it.
void expect_cut(const Scene& scene, const std::string& text) {
  Scene nameless = scene;
  for (BlockDescription& block : nameless.blocks) block.name.clear();
  CutCounts counts;
  const Scene cut =
      cut_blocks(nameless, {.shortest_edge = 0, .drop_straight = false, .convex = true}, counts);
  double before = 0, after = 0;
  for (const BlockDescription& block : scene.blocks) before += std::abs(polyfem::signed_area(block.vertices));
  for (const BlockDescription& block : cut.blocks) {
    after += std::abs(polyfem::signed_area(block.vertices));
    if (polyfem::signed_area(block.vertices) < 0) continue;  // as it was given: convex
    EXPECT_FALSE(polyfem::find_non_convex_corner(block.vertices)) << text;
  }
  EXPECT_NEAR(after, before, 1e-8 * before) << text;
}

/// Either a valid scene that can be written and read again, or problems with their places; whether it is a
/// scene.
bool expect_read_or_refused(const SceneReading& reading, const std::string& mutant) {
  EXPECT_EQ(reading.scene.has_value(), !has_errors(reading.problems)) << mutant;
  for (const Problem& problem : reading.problems) {
    EXPECT_GE(problem.line, 1) << mutant;
    EXPECT_GE(problem.column, 1) << mutant;
    EXPECT_EQ(problem.text().find('\n'), std::string::npos) << mutant;
    EXPECT_EQ(problem.text().find("the scene cannot be read:"), std::string::npos) << problem.text() << '\n'
                                                                                   << mutant;
  }
  if (!reading.scene) return false;
  expect_sound(*reading.scene, mutant);
  expect_cut(*reading.scene, mutant);
  std::ostringstream first, second;
  write_scene(first, *reading.scene);
  const SceneReading again = read(first.str());
  EXPECT_TRUE(again.scene) << all_text(again.problems) << first.str();
  if (again.scene) write_scene(second, *again.scene);
  EXPECT_EQ(first.str(), second.str());
  return true;
}

TEST(Fuzz, MutatedScenesAreReadOrRefused) {
  unsigned accepted = 0, total = 0;
  for (const std::string_view text : {complete, minimal, moving, shapes, in_stages}) {
    ASSERT_TRUE(scene_of(text).blocks.size() > 0);
    for (unsigned seed = 0; seed < n_mutants(); ++seed, ++total) {
      const std::string mutant = Mutator(seed)(std::string(text));
      if (expect_read_or_refused(read(mutant), mutant)) ++accepted;
    }
  }
  // The mutations are mild enough that both ways are tried.
  EXPECT_GT(accepted, total / 50);
  EXPECT_LT(accepted, total / 2);
}

constexpr std::string_view geojson = R"({"type": "FeatureCollection", "name": "wall", "features": [
{"type": "Feature", "properties": {"name": "base", "material": "soil", "fixed": [0, 1], "fid": 1},
 "geometry": {"type": "Polygon", "coordinates": [[[0, -1], [8, -1, 0], [8, 0], [0, 0], [0, -1]]]}},
{"type": "Feature", "properties": {"name": "slider", "model": "affine", "material": null},
 "geometry": {"type": "MultiPolygon", "coordinates": [[[[1, 2], [1, 0], [5, 0], [5.1, 2], [1, 2]]]]}},
{"type": "Feature", "id": 3, "properties": {"material": 1, "fixed": true},
 "geometry": {"type": "GeometryCollection", "geometries": [
  {"coordinates": [[[6, 0], [7, 0], [6.5, 9e-1], [6, 0]]], "type": "Polygon"},
  {"type": "MultiPolygon", "coordinates": [[[[16, 0], [16.5, 0.9], [17, 0], [16, 0]]]]}]}}
]}
)";

constexpr std::string_view wkt = R"(# a wall
POLYGON ((0 -1, 8 -1, 8 0, 0 0, 0 -1))
MULTIPOLYGON Z (((1 0 0, 5 0 0, 5 2 0, 1 2 0, 1 0 0)),
                ((6 0 0, 7 0 0, 6 1e0 0, 6 0 0))) # two of them
GEOMETRYCOLLECTION (POLYGON ((10 0, 11 0, 10 1, 10 0)), POLYGON((12 0,12.5 1,13 0,12 0)))
)";

class FuzzGeometry : public GeometryScenes {};

TEST_F(FuzzGeometry, MutatedFilesAreReadOrRefused) {
  const std::string rest =
      std::string(without_blocks) +
      "[[monitor]]\nname = \"m\"\nblock = 1\nvertex = 2\n[[load]]\ntype = \"pressure\"\n" +
      "block = 2\nedge = 1\nvalue = 10\n";
  for (const auto& [name, text] : {std::pair{"a.geojson", geojson}, std::pair{"a.wkt", wkt}}) {
    ASSERT_EQ(scene_with(name, text, rest).blocks.size(), text == wkt ? 5u : 4u);
    unsigned accepted = 0;
    for (unsigned seed = 0; seed < n_mutants(); ++seed) {
      const std::string mutant = Mutator(seed)(std::string(text));
      if (expect_read_or_refused(read_with(name, mutant, rest), mutant)) ++accepted;
    }
    EXPECT_GT(accepted, n_mutants() / 50) << name;
    EXPECT_LT(accepted, n_mutants() / 2) << name;
  }
}

TEST(Fuzz, MutatedSettingsAreAppliedOrRefused) {
  static const char* const settings[] = {"analysis.time_step=0.01",
                                         "analysis.damping.mass=0.01",
                                         "block.slider.mesh.cells=16",
                                         "analysis.mesh.cell_size=1 cm",
                                         "block.slider.vertices.2.1=3",
                                         "joint.0.friction_angle=15",
                                         "contact.normal_stiffness=\"1 MN/m\"",
                                         "load.0.force=[0, 1]",
                                         "stage.settle.joints.interface.cohesion=1",
                                         "stage.1.joints.1={ dashpot = 0.5 }",
                                         "stage.excavate.remove.1=beam",
                                         "stage.2.steps=3"};
  for (unsigned seed = 0; seed < n_mutants(); ++seed) {
    Mutator mutate(seed);
    const std::string setting = mutate(settings[mutate.below(std::size(settings))]);
    for (const std::string_view text : {complete, in_stages}) {
      const SceneReading reading = read(text, {setting});
      EXPECT_EQ(reading.scene.has_value(), !has_errors(reading.problems));
      if (reading.scene) expect_sound(*reading.scene, setting);
    }
  }
}

TEST_F(FuzzGeometry, RandomBytesAreRefused) {
  std::mt19937 random(1);
  for (int i = 0; i < 500; ++i) {
    std::string text(random() % 200, '\0');
    for (char& c : text) c = static_cast<char>(random() % 256);
    EXPECT_FALSE(read_with("a.json", text).scene);
    EXPECT_FALSE(read_with("a.wkt", text).scene);
  }
}

TEST(Fuzz, RandomBytesAreRefused) {
  std::mt19937 random(1);
  for (int i = 0; i < 500; ++i) {
    std::string text(random() % 200, '\0');
    for (char& c : text) c = static_cast<char>(random() % 256);
    EXPECT_FALSE(read(text).scene);
  }
}

}  // namespace
