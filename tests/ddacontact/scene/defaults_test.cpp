#include "example_scenes.hpp"

namespace {

using namespace example_scenes;
using namespace ddacontact;

TEST(Defaults, KeysWrittenOutWinOverThePreset) {
  const Scene scene = scene_of(
      minimal, {"analysis.preset=paper", "analysis.gradient_correction=true", "analysis.block_model=affine",
                "analysis.cutting_factor=0.5", "analysis.kinematics=corotational", "analysis.scheme=midpoint",
                "contact.method=staged"});
  EXPECT_EQ(scene.analysis.kinematics, Kinematics::corotational);
  EXPECT_EQ(scene.analysis.scheme, Scheme::midpoint);
  EXPECT_EQ(scene.contact.method, ContactMethod::staged);
  EXPECT_EQ(scene.analysis.gradient_correction, GradientCorrection::on);
  EXPECT_EQ(scene.blocks[0].model, BlockModel::affine);
  EXPECT_EQ(scene.analysis.cutting_factor, 0.5);
  EXPECT_EQ(scene_of(minimal, {"analysis.gradient_correction=false"}).analysis.gradient_correction,
            GradientCorrection::off);
}

TEST(Defaults, OfTheSchemeGoWithTheKinematics) {
  EXPECT_EQ(scene_of(minimal, {"analysis.kinematics=incremental"}).analysis.scheme, Scheme::dda);
  EXPECT_EQ(scene_of(minimal, {"analysis.kinematics=corotational"}).analysis.scheme, Scheme::decaying);
  const std::vector<std::string> turning_paper{"analysis.preset=paper", "analysis.kinematics=corotational"};
  EXPECT_EQ(scene_of(minimal, turning_paper).analysis.scheme, Scheme::dda);
}

TEST(Defaults, OfThePenetrationToleranceGoWithTheMethod) {
  EXPECT_EQ(scene_of(minimal, {"contact.method=classic"}).contact.penetration_tolerance, 0);
  EXPECT_EQ(
      scene_of(minimal, {"analysis.preset=paper", "contact.method=staged"}).contact.penetration_tolerance,
      1e-6);
  EXPECT_EQ(scene_of(minimal, {"contact.penetration_tolerance=0"}).contact.method, ContactMethod::staged);
}

TEST(Defaults, OfNewmarkAreStable) {
  const AnalysisOptions alone = scene_of(minimal, {"analysis.scheme=newmark"}).analysis;
  EXPECT_EQ(alone.gamma, 0.5);
  EXPECT_EQ(alone.beta, 0.25);
  for (const char* gamma : {"0.5", "0.5000000000000001", "0.6", "1.0", "7.0", "1000"}) {
    const Scene scene =
        scene_of(minimal, {"analysis.scheme=newmark", std::string("analysis.gamma=") + gamma});
    EXPECT_GE(2 * scene.analysis.beta, scene.analysis.gamma);
  }
}

TEST(Reading, NewmarkMayBeAnyThatIsStableAtEveryTimeStep) {
  // The average acceleration, the scheme of the paper, and one on the edge with digits that round.
  for (const auto& [beta, gamma] :
       {std::pair{"0.25", "0.5"}, std::pair{"0.5", "1"}, std::pair{"0.3", "0.6"}, std::pair{"3", "0.5"}})
    EXPECT_TRUE(read(minimal, {"analysis.scheme=newmark", std::string("analysis.beta=") + beta,
                               std::string("analysis.gamma=") + gamma})
                    .scene)
        << beta << ' ' << gamma;
}

TEST(Reading, EverySchemeGoesWithTheTurningFrame) {
  for (const char* scheme : {"decaying", "explicit", "midpoint", "dda", "newmark", "backward_euler"})
    EXPECT_TRUE(read(minimal, {std::string("analysis.scheme=") + scheme}).scene) << scheme;
  for (const char* scheme : {"dda", "newmark", "backward_euler"})
    EXPECT_TRUE(
        read(minimal, {std::string("analysis.scheme=") + scheme, "analysis.kinematics=incremental"}).scene)
        << scheme;
}

TEST(Reading, TheClassicMethodTakesWhatTheSpringsGive) {
  const std::vector<std::string> settings{"contact.method=classic", "contact.penetration_tolerance=0",
                                          "joint.0.restitution=0", "joint.0.dashpot=0.5"};
  EXPECT_EQ(scene_of(complete, settings).joints[0].dashpot, 0.5);
}

TEST(Reading, EveryModelHasItsWord) {
  for (const auto& [word, model] :
       {std::pair{"auto", BlockModel::automatic}, std::pair{"wachspress", BlockModel::wachspress},
        std::pair{"mean_value", BlockModel::mean_value}, std::pair{"affine", BlockModel::affine},
        std::pair{"mesh", BlockModel::mesh}}) {
    const Scene scene = scene_of(
        std::string(minimal) + "[[block]]\nmaterial = \"rock\"\nvertices = [[2, 0], [3, 0], [3, 1]]\n",
        {"analysis.block_model=affine", std::string("block.0.model=") + word});
    EXPECT_EQ(scene.blocks[0].model, model);
    EXPECT_EQ(scene.blocks[1].model, BlockModel::affine);
    EXPECT_EQ(scene_of(minimal, {std::string("analysis.block_model=") + word}).blocks[0].model, model);
  }
}

TEST(Reading, AMeshIsTheBlocksOwnKeyByKey) {
  const std::string text = std::string(minimal) +
                           "[[block]]\nmaterial = \"rock\"\nvertices = [[2, 0], [3, 0], [3, 1]]\n"
                           "mesh = { cells = 7 }\n";
  const Scene scene =
      scene_of(text, {"analysis.mesh={ cell_size = \"20 cm\", kind = \"quads\", edge_nodes = false }"});
  EXPECT_EQ(scene.analysis.mesh, (MeshOptions{CellKind::quads, 64, 0.2, false}));
  EXPECT_EQ(scene.blocks[0].mesh, scene.analysis.mesh);
  EXPECT_EQ(scene.blocks[1].mesh, (MeshOptions{CellKind::quads, 7, 0, false})) << "cells instead of a size";

  const Scene other = scene_of(text, {"analysis.mesh.cells=9", "block.0.mesh.cell_size=0.5"});
  EXPECT_EQ(other.blocks[0].mesh, (MeshOptions{CellKind::by_shape, 9, 0.5, true})) << "a size instead";
  EXPECT_EQ(other.blocks[1].mesh, (MeshOptions{CellKind::by_shape, 7, 0, true}));
}

TEST(Reading, MeshOptionsOfOtherModelsWait) {
  // Quads would not fit into the triangle: but it is not meshed.
  const std::string text = replaced(minimal, "[1, 1], [0, 1]]", "[1, 1]]\nmesh = { kind = \"quads\" }");
  EXPECT_TRUE(read(text).scene);
  EXPECT_TRUE(read(text, {"block.0.model=affine"}).scene);
  EXPECT_FALSE(read(text, {"block.0.model=mesh"}).scene);
  EXPECT_TRUE(read(minimal, {"block.0.model=mesh", "block.0.mesh.kind=quads"}).scene);
}

TEST(Defaults, TangentialStiffnessFollowsTheNormalOne) {
  EXPECT_EQ(scene_of(minimal, {"contact.normal_stiffness=1e8"}).contact.tangential_stiffness, 4e7);
  EXPECT_EQ(scene_of(minimal, {"contact.tangential_stiffness=1e8"}).contact.normal_stiffness, 40e9);
}

TEST(Defaults, StiffnessesBeyondWhatCouldBeWrittenAreRefused) {
  EXPECT_FALSE(read(minimal, {"material.rock.young=1e60"}).scene);
  EXPECT_TRUE(read(minimal, {"material.rock.young=1e60", "contact.normal_stiffness=1"}).scene);
  EXPECT_FALSE(read(minimal, {"contact.normal_stiffness=1e-30"}).scene);
}

TEST(Defaults, ExplicitDefaultsOfWhatIsNotAvailableAreAccepted) {
  const Scene scene =
      scene_of(minimal, {"analysis.preset=default", "analysis.block_model=auto", "analysis.scheme=dda",
                         "analysis.kinematics=incremental", "contact.method=classic",
                         "contact.penetration_tolerance=0", "output.checkpoint_every=0"});
  EXPECT_EQ(scene.contact.penetration_tolerance, 0);
}

TEST(Reading, ResolvesEveryTable) {
  const Scene scene = scene_of(complete);
  EXPECT_EQ(scene.title, "Complete");
  EXPECT_DOUBLE_EQ(scene.materials[1].density, 21000 / 9.8);
  EXPECT_EQ(scene.materials[1].young, 5e6);
  ASSERT_TRUE(scene.joints[1].between);
  EXPECT_EQ(*scene.joints[1].between, (std::array<int, 2>{0, 1}));
  EXPECT_EQ(scene.joints[1].cohesion, 1000);
  EXPECT_EQ(scene.blocks[0].material, 1);
  EXPECT_EQ(scene.blocks[0].fixed_vertices, (std::vector<int>{0, 1}));
  EXPECT_EQ(scene.blocks[1].model, BlockModel::affine);
  EXPECT_DOUBLE_EQ(scene.blocks[1].angular_velocity, 5 * 3.14159265358979323846 / 180);
  EXPECT_EQ(scene.blocks[1].stress, Vec3(0, -1000, 0));
  EXPECT_EQ(scene.blocks[2].vertices.col(2), Vec2(6.5, 0.9));

  ASSERT_EQ(scene.supports.size(), 2u);
  EXPECT_TRUE(scene.supports[0].fix_x);
  EXPECT_FALSE(scene.supports[0].fix_y);
  EXPECT_EQ(scene.supports[0].displacement.kind, TimeFunction::Kind::ramp);
  EXPECT_EQ(scene.supports[0].displacement.value, Vec2(0.1, 0));
  EXPECT_EQ(scene.supports[1].block, 2);
  EXPECT_EQ(scene.supports[1].displacement.kind, TimeFunction::Kind::history);
  EXPECT_EQ(scene.supports[1].displacement.at(0.5, 1), Vec2(0.05, 0));

  ASSERT_EQ(scene.loads.size(), 3u);
  EXPECT_EQ(scene.loads[0].kind, Load::Kind::point);
  EXPECT_EQ(scene.loads[0].force.value, Vec2(1000, -50));
  EXPECT_EQ(scene.loads[1].edge, 1);
  EXPECT_EQ(scene.loads[1].force.value.x(), 2000);
  EXPECT_EQ(scene.loads[2].block, 2);
  EXPECT_EQ(scene.loads[2].force.value, Vec2(1000, 0));

  ASSERT_EQ(scene.monitors.size(), 3u);
  EXPECT_EQ(scene.monitors[0].kind, Monitor::Kind::centroid);
  EXPECT_EQ(scene.monitors[1].kind, Monitor::Kind::vertex);
  EXPECT_EQ(scene.monitors[1].vertex, 3);
  EXPECT_EQ(scene.monitors[2].kind, Monitor::Kind::point);
  EXPECT_EQ(scene.monitors[2].at, Vec2(3, 2));
  EXPECT_EQ(scene.output.every, 5);
  EXPECT_EQ(scene.output.fields, std::vector<std::string>{"displacement"});
}

TEST(Reading, SupportsMayStandStillMoveSteadilyOrFollowAHistory) {
  const std::string support = std::string(minimal) + "[[support]]\nblock = 0\nvertices = [0]\n";
  const TimeFunction still = scene_of(support).supports[0].displacement;
  EXPECT_EQ(still.at(3, 1), Vec2(0, 0));
  const TimeFunction steady = scene_of(support + "velocity = [2, 0]").supports[0].displacement;
  EXPECT_EQ(steady.kind, TimeFunction::Kind::rate);
  EXPECT_EQ(steady.at(3, 1), Vec2(6, 0));
}

TEST(Reading, AStillSupportMayHoldWhatIsFixed) {
  const std::string text = replaced(minimal, "[[block]]", "[[block]]\nfixed = true");
  EXPECT_EQ(scene_of(text + "[[support]]\nblock = 0\nvertices = [0]\n").supports.size(), 1u);
}

/// A density in t/m3, kN/m3 or N/m3 is a number that is not written with its unit.
TEST(Reading, DensitiesOfNoUsualMaterialAreWarnedOf) {
  const auto text_of = [](const char* density, std::vector<std::string> settings = {}) {
    return all_text(read(replaced(minimal, "density = 2500", density), settings).problems);
  };
  for (const auto& [density, cure] : {std::pair{"density = 2.5", "write density = \"2.5 t/m3\""},
                                      std::pair{"density = 25", "write unit_weight = \"25 kN/m3\""},
                                      std::pair{"density = 25000", "write unit_weight = 25000"},
                                      std::pair{"unit_weight = 25", "write unit_weight = \"25 kN/m3\""},
                                      std::pair{"density = 0.1", "'density' is in kg/m3"}}) {
    const std::string text = text_of(density);
    EXPECT_NE(text.find("6:"), std::string::npos) << text;
    EXPECT_NE(text.find("warning: material \"rock\" has a density of "), std::string::npos) << text;
    EXPECT_NE(text.find(cure), std::string::npos) << text;
  }
  for (const char* usual :
       {"density = 100", "density = 11340", "density = \"2.5 t/m3\"", "unit_weight = \"25 kN/m3\""})
    EXPECT_EQ(text_of(usual), "") << usual;
  EXPECT_EQ(text_of("density = 2.5", {"analysis.gravity=[0, 0]"}), "");
}

TEST(Reading, AVertexWithinAFaceThatCrushesIsWarnedOf) {
  const std::string joint = "[[joint]]\ncompressive_strength = 5e6\n",
                    divided = replaced(minimal, "[1, 1]", "[1, 0.4], [1, 1]");
  EXPECT_NE(all_text(read(divided + joint).problems).find("within a straight face, at (1, 0.4)"),
            std::string::npos);
  EXPECT_EQ(all_text(read(std::string(minimal) + joint).problems), "");
  EXPECT_EQ(all_text(read(divided).problems), "");
}

/// By the law of Coulomb it bears no shear where it is pulled.
TEST(Reading, TensileStrengthWithoutCohesionIsWarnedOf) {
  const auto text_of = [](const std::string& joint) {
    return all_text(read(std::string(minimal) + "[[joint]]\n" + joint).problems);
  };
  EXPECT_NE(text_of("friction_angle = 30\ntensile_strength = 1e5\n")
                .find("warning: 'tensile_strength' without 'cohesion'"),
            std::string::npos);
  EXPECT_EQ(text_of("friction_angle = 30\ntensile_strength = 1e5\ncohesion = 6e4\n"), "");
  EXPECT_EQ(text_of("tensile_strength = 1e5\n"), "");
}

}  // namespace
