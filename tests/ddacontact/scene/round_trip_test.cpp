#include "example_scenes.hpp"

#include <ddacontact/scene/writer.hpp>

#include <sstream>

namespace {

using namespace example_scenes;

std::string written(const Scene& scene) {
  std::ostringstream out;
  ddacontact::write_scene(out, scene);
  return out.str();
}

void expect_same(const Scene& a, const Scene& b) {
  EXPECT_EQ(written(a), written(b));
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  for (std::size_t i = 0; i < a.blocks.size(); ++i) {
    EXPECT_EQ(a.blocks[i].vertices, b.blocks[i].vertices);
    EXPECT_EQ(a.blocks[i].model, b.blocks[i].model);
    EXPECT_EQ(a.blocks[i].mesh, b.blocks[i].mesh);
    EXPECT_EQ(a.blocks[i].fixed, b.blocks[i].fixed);
    EXPECT_EQ(a.blocks[i].fixed_vertices, b.blocks[i].fixed_vertices);
    EXPECT_EQ(a.blocks[i].angular_velocity, b.blocks[i].angular_velocity);
    EXPECT_EQ(a.blocks[i].stress, b.blocks[i].stress);
  }
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (std::size_t i = 0; i < a.materials.size(); ++i)
    EXPECT_EQ(a.materials[i].density, b.materials[i].density);
  ASSERT_EQ(a.joints.size(), b.joints.size());
  for (std::size_t i = 0; i < a.joints.size(); ++i) EXPECT_EQ(a.joints[i].between, b.joints[i].between);
  EXPECT_EQ(a.analysis.time_step, b.analysis.time_step);
  EXPECT_EQ(a.contact.tangential_stiffness, b.contact.tangential_stiffness);
  ASSERT_EQ(a.supports.size(), b.supports.size());
  for (std::size_t i = 0; i < a.supports.size(); ++i)
    for (const double t : {0.0, 0.1, 0.7, 2.0})
      EXPECT_EQ(a.supports[i].displacement.at(t, a.end_time()),
                b.supports[i].displacement.at(t, b.end_time()));
}

TEST(RoundTrip, KeepsTheScene) {
  for (const std::string_view text : {complete, minimal}) {
    const Scene scene = scene_of(text);
    expect_same(scene, scene_of(written(scene)));
  }
}

TEST(RoundTrip, KeepsNumbersToTheBit) {
  const std::string text = replaced(minimal, "[1, 1]", "[0.1, 1.0000000000000002]");
  const Scene scene = scene_of(text, {"analysis.time_step=0.30000000000000004", "material.rock.young=1e22"});
  const Scene again = scene_of(written(scene));
  EXPECT_EQ(again.analysis.time_step, 0.30000000000000004);
  EXPECT_EQ(again.materials[0].young, 1e22);
  EXPECT_EQ(again.blocks[0].vertices, scene.blocks[0].vertices);
}

TEST(RoundTrip, KeepsNamesOfAnyCharacters) {
  const std::string name = "a \\\" quoted\\\\, \u00e9t\u00e9 [x] = #1";
  const std::string text = replaced(minimal, "[[block]]", "[[block]]\nname = \"" + name + "\"");
  const Scene scene = scene_of(text, {"title=two\nlines\tand \x01"});
  const Scene again = scene_of(written(scene));
  EXPECT_EQ(again.blocks[0].name, "a \" quoted\\, \u00e9t\u00e9 [x] = #1");
  EXPECT_EQ(again.title, "two\nlines\tand \x01");
}

TEST(RoundTrip, StatesEveryDefault) {
  const std::string text = written(scene_of(minimal));
  for (const char* line : {"format = 1",
                           "preset = \"default\"",
                           "block_model = \"auto\"",
                           "model = \"auto\"",
                           "mode = \"dynamic\"",
                           "plane = \"strain\"",
                           "max_displacement_ratio = 0.1",
                           "cohesion = 0.0",
                           "tensile_strength = 0.0",
                           "checkpoint_every = 0",
                           "mesh = { kind = \"auto\", cells = 64, edge_nodes = true }",
                           "gradient_correction = true",
                           "cutting_factor = 0.5",
                           "normal_stiffness = 4e+10",
                           "tangential_stiffness = 1.6e+10",
                           "gravity = [0.0, -9.8]",
                           "name = \"default\"",
                           "friction_angle = 0.0",
                           "fixed = false",
                           "every = 1",
                           "method = \"staged\"",
                           "kinematics = \"corotational\"",
                           "scheme = \"decaying\"",
                           "penetration_tolerance = 1e-06",
                           "damping = { mass = 0.0, stiffness = 0.0 }",
                           "dashpot = 0.0",
                           "skip = { friction_rows = true, fixed_blocks = true, unchanged_factor = true, "
                           "congruent = true, output = true, cg = true, islands = true, "
                           "sleep = true, skin = true }"})
    EXPECT_NE(text.find(std::string(line) + '\n'), std::string::npos) << line << " in\n" << text;
  EXPECT_EQ(text.find("beta ="), std::string::npos) << "a key of another scheme is no default";
  EXPECT_EQ(text.find("mesh ="), text.rfind("mesh =")) << "a block says what differs from the analysis";
}

TEST(RoundTrip, StatesTheDefaultsOfThePaper) {
  const std::string text = written(scene_of(minimal, {"analysis.preset=paper"}));
  for (const char* line : {"preset = \"paper\"", "block_model = \"wachspress\"", "model = \"wachspress\"",
                           "kinematics = \"incremental\"", "scheme = \"dda\"", "gradient_correction = false",
                           "cutting_factor = 0.3", "method = \"classic\"", "penetration_tolerance = 0.0",
                           "normal_stiffness = 4e+10"})
    EXPECT_NE(text.find(std::string(line) + '\n'), std::string::npos) << line << " in\n" << text;
}

TEST(RoundTrip, KeepsTheMechanics) {
  const std::vector<std::string> all[] = {
      {"analysis.preset=paper"},
      {"analysis.preset=paper", "analysis.kinematics=corotational", "analysis.scheme=midpoint"},
      {"analysis.scheme=newmark", "analysis.gamma=0.7", "analysis.damping.mass=0.1"},
      {"analysis.scheme=newmark", "analysis.beta=0.3", "analysis.damping.stiffness=0.1"},
      {"analysis.kinematics=incremental", "contact.method=classic", "analysis.cutting_factor=0.1"},
      {"analysis.scheme=backward_euler", "contact.penetration_tolerance=0.25", "joint.0.restitution=0.3"}};
  for (const std::vector<std::string>& settings : all) {
    const Scene scene = scene_of(complete, settings), again = scene_of(written(scene));
    expect_same(scene, again);
    EXPECT_EQ(again.analysis.kinematics, scene.analysis.kinematics);
    EXPECT_EQ(again.analysis.scheme, scene.analysis.scheme);
    EXPECT_EQ(again.analysis.beta, scene.analysis.beta);
    EXPECT_EQ(again.analysis.gamma, scene.analysis.gamma);
    EXPECT_EQ(again.analysis.damping.mass, scene.analysis.damping.mass);
    EXPECT_EQ(again.analysis.damping.stiffness, scene.analysis.damping.stiffness);
    EXPECT_EQ(again.contact.method, scene.contact.method);
    EXPECT_EQ(again.contact.penetration_tolerance, scene.contact.penetration_tolerance);
    EXPECT_EQ(again.joints[0].restitution, scene.joints[0].restitution);
  }
}

/// As results of earlier versions have it.
TEST(RoundTrip, ReadsASkipThatThereIsNoMore) {
  EXPECT_EQ(scene_of(in_stages, {"solver.skip.stale_factor=true"}).analysis.skip, ddacontact::Skips{});
}

TEST(RoundTrip, KeepsTheSkips) {
  const std::vector<std::string> off{"friction_rows", "fixed_blocks", "unchanged_factor",
                                     "congruent",     "output",       "cg",
                                     "islands",       "sleep",        "skin"};
  for (const std::string& skip : off) {
    const Scene scene = scene_of(in_stages, {"solver.skip." + skip + "=false"});
    EXPECT_NE(scene.analysis.skip, ddacontact::Skips{}) << skip;
    for (const auto& stage : scene.stages) EXPECT_EQ(stage.analysis.skip, scene.analysis.skip) << skip;
    EXPECT_EQ(scene_of(written(scene)).analysis.skip, scene.analysis.skip) << skip;
  }
}

TEST(RoundTrip, KeepsModelsAndMeshes) {
  const std::vector<std::string> all[] = {
      {"analysis.mesh.cell_size=0.25", "block.slider.mesh.cells=5", "block.slider.model=mesh"},
      {"analysis.mesh.cells=5", "block.slider.mesh.cell_size=25 cm", "block.base.model=mean_value"},
      {"analysis.mesh={ kind = \"quads\", edge_nodes = false }", "block.base.mesh.kind=voronoi",
       "analysis.block_model=mesh", "block.2.model=auto"},
      {"block.base.mesh.edge_nodes=false", "block.base.mesh.kind=quads", "block.base.mesh.cells=1000000"}};
  for (const std::vector<std::string>& settings : all) {
    const Scene scene = scene_of(complete, settings), again = scene_of(written(scene));
    expect_same(scene, again);
    EXPECT_EQ(again.analysis.block_model, scene.analysis.block_model);
    EXPECT_EQ(again.analysis.mesh, scene.analysis.mesh);
  }
}

TEST(RoundTrip, WritesTimeFunctionsThatNoFileStates) {
  Scene scene = scene_of(std::string(minimal) + "[[support]]\nblock = 0\nvertices = [0]\n" +
                         "[[load]]\ntype = \"body\"\nblock = 0\nforce = [1, 0]\n");
  scene.supports[0].displacement = {ddacontact::TimeFunction::Kind::constant, {1, 2}, {}};
  scene.loads[0].force = {ddacontact::TimeFunction::Kind::ramp, {1, 2}, {}};
  const Scene again = scene_of(written(scene));
  for (const double t : {0.0, 0.005, 0.01, 1.0}) {
    EXPECT_EQ(again.supports[0].displacement.at(t, 0.01), scene.supports[0].displacement.at(t, 0.01));
    EXPECT_EQ(again.loads[0].force.at(t, 0.01), scene.loads[0].force.at(t, 0.01));
  }
}

}  // namespace
