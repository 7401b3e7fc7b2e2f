#include "example_scenes.hpp"

namespace {

using namespace example_scenes;
using ddacontact::BlockModel;
using ddacontact::Vec2;

TEST(Settings, ReplaceValues) {
  const Scene scene = scene_of(
      complete, {"analysis.time_step=0.01", "joint.0.friction_angle=15", "block.slider.model=wachspress",
                 "material.rock.young=35 GPa", "block.2.vertices.2.1=1.5", "title=Two words",
                 "load.0.force.0=\"2 kN\"", "analysis.steps = 7"});
  EXPECT_EQ(scene.analysis.time_step, 0.01);
  EXPECT_EQ(scene.analysis.steps, 7);
  EXPECT_EQ(scene.joints[0].friction_angle, 15);
  EXPECT_EQ(scene.blocks[1].model, BlockModel::wachspress);
  EXPECT_EQ(scene.materials[0].young, 35e9);
  EXPECT_EQ(scene.blocks[2].vertices.col(2), Vec2(6.5, 1.5));
  EXPECT_EQ(scene.loads[0].force.value, Vec2(2000, -50));
  EXPECT_EQ(scene.title, "Two words");
}

TEST(Settings, AddKeysAndTables) {
  const Scene scene =
      scene_of(minimal, {"contact.normal_stiffness=1e8", "output.every=3", "analysis.plane=stress",
                         "block.0.velocity=[1, 2]", "block.0.fixed=true", "analysis.preset=paper"});
  EXPECT_EQ(scene.contact.normal_stiffness, 1e8);
  EXPECT_EQ(scene.output.every, 3);
  EXPECT_EQ(scene.analysis.plane, ddacontact::Plane::stress);
  EXPECT_EQ(scene.blocks[0].velocity, Vec2(1, 2));
  EXPECT_TRUE(scene.blocks[0].fixed);
  EXPECT_EQ(scene.analysis.preset, ddacontact::Preset::paper);
}

TEST(Settings, ReachIntoDamping) {
  const Scene added = scene_of(minimal, {"analysis.damping.mass=0.1", "analysis.damping.stiffness=2 ms"});
  EXPECT_EQ(added.analysis.damping.mass, 0.1);
  EXPECT_EQ(added.analysis.damping.stiffness, 2e-3);
  const std::string text = replaced(minimal, "steps = 1", "steps = 1\ndamping = { mass = 3, stiffness = 4 }");
  const Scene replaced_part = scene_of(text, {"analysis.damping.mass=5"});
  EXPECT_EQ(replaced_part.analysis.damping.mass, 5);
  EXPECT_EQ(replaced_part.analysis.damping.stiffness, 4);
  EXPECT_EQ(scene_of(text, {"analysis.damping={ mass = 1 }"}).analysis.damping.stiffness, 0);
}

TEST(Settings, ReachIntoSkips) {
  const Scene scene = scene_of(minimal, {"solver.skip.sleep=false"});
  ddacontact::Skips expected;
  expected.sleep = false;
  EXPECT_EQ(scene.analysis.skip, expected);
  const std::string text = replaced(minimal, "[[material]]", "[solver]\nskip = { cg = false }\n[[material]]");
  expected.cg = false;
  EXPECT_EQ(scene_of(text, {"solver.skip.sleep=false"}).analysis.skip, expected);
}

TEST(Settings, ReachIntoMeshes) {
  const Scene added = scene_of(complete, {"analysis.mesh.cells=16", "block.slider.mesh.cells=8",
                                          "block.slider.mesh.edge_nodes=false", "block.2.mesh.kind=quads"});
  EXPECT_EQ(added.analysis.mesh.cells, 16);
  EXPECT_EQ(added.blocks[1].mesh.cells, 8);
  EXPECT_FALSE(added.blocks[1].mesh.edge_nodes);
  EXPECT_EQ(added.blocks[2].mesh.cells, 16);
  EXPECT_EQ(added.blocks[2].mesh.kind, ddacontact::CellKind::quads);
  const std::string text =
      replaced(minimal, "steps = 1", "steps = 1\nmesh = { cells = 3, kind = \"quads\" }");
  EXPECT_EQ(scene_of(text, {"analysis.mesh.cells=5"}).analysis.mesh.cells, 5);
  EXPECT_EQ(scene_of(text, {"analysis.mesh.cells=5"}).analysis.mesh.kind, ddacontact::CellKind::quads);
}

TEST(Settings, AConcaveBlockIsRefusedWhereItIsMadeOne) {
  const char* setting = "block.0.vertices.2=[0.25, 0.25]";
  EXPECT_TRUE(read(minimal, {setting}).scene);
  const SceneReading reading = read(minimal, {"block.0.model=wachspress", setting});
  ASSERT_EQ(reading.problems.size(), 1u) << all_text(reading.problems);
  EXPECT_EQ(reading.problems[0].file, std::string("--set ") + setting);
  EXPECT_NE(reading.problems[0].text().find("concave"), std::string::npos);
}

TEST(Settings, ChooseTheMechanics) {
  const Scene scene =
      scene_of(complete, {"analysis.kinematics=corotational", "analysis.scheme=newmark", "analysis.gamma=0.6",
                          "contact.method=staged", "contact.penetration_tolerance=1e-4",
                          "joint.0.restitution=0.5", "joint.weak.dashpot=0.1"});
  EXPECT_EQ(scene.analysis.kinematics, ddacontact::Kinematics::corotational);
  EXPECT_EQ(scene.analysis.scheme, ddacontact::Scheme::newmark);
  EXPECT_EQ(scene.analysis.gamma, 0.6);
  EXPECT_EQ(scene.contact.method, ddacontact::ContactMethod::staged);
  EXPECT_EQ(scene.contact.penetration_tolerance, 1e-4);
  EXPECT_EQ(scene.joints[0].restitution, 0.5);
  EXPECT_EQ(scene.joints[1].restitution, std::nullopt);
  EXPECT_EQ(scene.joints[1].dashpot, 0.1);
}

TEST(Settings, TheLastOneCounts) {
  EXPECT_EQ(scene_of(minimal, {"analysis.steps=3", "analysis.steps=4"}).analysis.steps, 4);
}

TEST(Settings, NamesWithDotsStandInQuotes) {
  const std::string text = replaced(minimal, "[[block]]", "[[block]]\nname = \"a.b\"");
  EXPECT_TRUE(scene_of(text, {"block.\"a.b\".fixed=true"}).blocks[0].fixed);
}

TEST(Settings, NamesGoBeforeIndices) {
  const std::string text = std::string(minimal) + "[[block]]\nname = \"0\"\nmaterial = \"rock\"\n" +
                           "vertices = [[2, 0], [3, 0], [3, 1], [2, 1]]\n";
  const Scene scene = scene_of(text, {"block.0.fixed=true"});
  EXPECT_FALSE(scene.blocks[0].fixed);
  EXPECT_TRUE(scene.blocks[1].fixed);
}

struct Case {
  const char* name;
  const char* setting;
  std::vector<const char*> words;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

class BadSetting : public testing::TestWithParam<Case> {};

TEST_P(BadSetting, IsNamedInTheProblem) {
  const Case& c = GetParam();
  const SceneReading reading = read(complete, {c.setting});
  EXPECT_FALSE(reading.scene);
  ASSERT_EQ(reading.problems.size(), 1u) << all_text(reading.problems);
  const Problem& problem = reading.problems[0];
  EXPECT_EQ(problem.file, std::string("--set ") + c.setting);
  EXPECT_EQ(problem.line, 1);
  EXPECT_EQ(problem.column, 1);
  for (const char* word : c.words)
    EXPECT_NE(problem.text().find(word), std::string::npos) << word << " in " << problem.text();
}

INSTANTIATE_TEST_SUITE_P(
    All, BadSetting,
    testing::Values(
        Case{"NoValue", "analysis.steps", {"PATH=VALUE"}}, Case{"NoPath", "=3", {"PATH=VALUE"}},
        Case{"Empty", "", {"PATH=VALUE"}}, Case{"EmptyPart", "analysis..steps=3", {"PATH=VALUE"}},
        Case{"UnknownTable", "analisys.steps=3", {"'analisys'", "'analysis'"}},
        Case{"UnknownKey", "analysis.stps=3", {"'stps'", "'steps'"}},
        Case{"UnknownElement", "block.slidr.model=affine", {"'slidr'", "'slider'"}},
        Case{"UnknownIndex", "block.3.model=affine", {"'3'", "0 to 2"}},
        Case{"UnknownKeyOfElement", "block.slider.modle=affine", {"'modle'", "'model'"}},
        Case{"NoKeyOfElement", "block.slider=3", {"names no key"}},
        Case{"NoSuchVertex", "block.slider.vertices.4.0=3", {"'4'", "4 elements"}},
        Case{"NoElements", "analysis.steps.0=3", {"'0'", "no elements"}},
        Case{"NoElementsOfTopKey", "title.x=3", {"'x'", "'title' has no elements"}},
        Case{"NotWritten", "block.0.velocity.1=3", {"'velocity'", "as a whole"}},
        Case{"WrongType", "analysis.steps=many", {"'steps'", "'many'"}},
        Case{"EmptyValue", "analysis.steps=", {"'steps'", "whole number"}},
        Case{"OutOfRange", "joint.0.friction_angle=95", {"'95'", "< 90"}},
        Case{"WrongUnit", "material.rock.young=35 mm", {"'mm'", "Pa"}},
        Case{"CellsOfNothing", "analysis.mesh.0=3", {"'mesh' is not in the scene"}},
        Case{"UnknownPartOfMesh", "block.slider.mesh.cell=3", {"unknown key 'cell' in 'mesh'", "'cells'"}},
        Case{"TooManyCells", "block.slider.mesh.cells=1000001", {"'mesh.cells' = '1000001'", "<= 1e+06"}},
        Case{"PartOfANumber", "analysis.cutting_factor.x=3", {"'cutting_factor' is a table", "a number"}},
        Case{"ElementOfATable", "analysis.damping.0=3", {"'damping' is not in the scene"}},
        Case{"UnknownPart", "analysis.damping.mas=3", {"unknown key 'mas' in 'damping'", "'mass'"}},
        Case{"PartOfAPart", "analysis.damping.mass.x=3", {"'damping.mass' is a table"}},
        Case{"PartOutOfRange", "analysis.damping.mass=-3", {"'damping.mass' = '-3'", ">= 0"}},
        Case{"Skip", "solver.skip.slep=true", {"unknown key 'slep' in 'skip'", "'sleep'"}},
        Case{"SkipNoTruth", "solver.skip.sleep=1", {"'sleep' is", "expected true or false"}},
        Case{"SolverKey", "solver.skipp.sleep=true", {"'skipp'", "did you mean 'skip'"}},
        Case{"NoGeometryFile", "blocks=no/wall.geojson", {"'no/wall.geojson'", "cannot be read"}},
        Case{"NoGeometryFormat", "blocks=wall.shp", {"'.shp'", ".geojson"}},
        Case{"ValueForTable", "analysis=3", {"'analysis'", "table"}},
        Case{"Crossing", "block.slider.vertices.2=[3, -1]", {"block 'slider'", "intersects itself"}},
        Case{"CrossingByNeighbour", "block.slider.vertices.1.0=-9", {"block 'slider'"}},
        Case{"NotUtf8", "title=\xff", {"utf-8"}}));

TEST(Settings, NeedWhatTheyName) {
  const SceneReading reading = read(minimal, {"joint.0.friction_angle=3"});
  ASSERT_EQ(reading.problems.size(), 1u);
  EXPECT_NE(reading.problems[0].text().find("no [[joint]]"), std::string::npos);
}

TEST(Settings, TheirProblemsComeAfterThoseOfTheFile) {
  const SceneReading reading = read(replaced(complete, "every = 5", "every = -5"), {"analysis.steps=0"});
  ASSERT_EQ(reading.problems.size(), 2u);
  EXPECT_EQ(reading.problems[0].file, "scene.toml");
  EXPECT_EQ(reading.problems[1].file, "--set analysis.steps=0");
}

}  // namespace
