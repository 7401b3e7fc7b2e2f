/// \file [[stage]]: what a stage takes over, what it changes, and what is refused.
#include "example_scenes.hpp"

#include <ddacontact/scene/writer.hpp>

#include <sstream>

namespace {

using namespace example_scenes;
using namespace ddacontact;

std::string written(const Scene& scene) {
  std::ostringstream out;
  write_scene(out, scene);
  return out.str();
}

TEST(Stages, OverrideKeysOfTheAnalysisAndKeepTheOthers) {
  const Scene scene = scene_of(in_stages);
  ASSERT_EQ(scene.stages.size(), 3u);
  const StageDescription &settle = scene.stages[0], &excavate = scene.stages[1], &last = scene.stages[2];
  EXPECT_EQ(settle.name, "settle");
  EXPECT_EQ(settle.analysis.mode, Mode::statics);
  EXPECT_EQ(settle.analysis.steps, 50);
  EXPECT_EQ(settle.analysis.time_step, 0.01);
  EXPECT_EQ(settle.analysis.gravity, Vec2(0, -9.8));
  EXPECT_TRUE(settle.reset_displacements);
  EXPECT_TRUE(settle.removed.empty());

  EXPECT_EQ(excavate.analysis.mode, Mode::dynamic) << "each stage starts from the analysis";
  EXPECT_EQ(excavate.analysis.time_step, 0.005);
  EXPECT_EQ(excavate.analysis.gravity, Vec2(0, -10));
  EXPECT_EQ(excavate.analysis.damping.mass, 0.5);
  EXPECT_EQ(excavate.removed, (std::vector<int>{1, 3}));
  EXPECT_FALSE(excavate.reset_displacements);

  EXPECT_EQ(last.name, "");
  EXPECT_EQ(last.analysis.damping.mass, 0);
  EXPECT_EQ(last.analysis.time_step, 0.01);
  EXPECT_EQ(last.analysis.kinematics, Kinematics::corotational);
}

TEST(Stages, ChangeJointsKeyByKeyWhileTheyLast) {
  const Scene scene = scene_of(in_stages);
  const std::vector<Joint>&settle = scene.stages[0].joints, &excavate = scene.stages[1].joints,
        &last = scene.stages[2].joints;
  EXPECT_EQ(scene.joints.at(0).friction_angle, 30);
  EXPECT_EQ(settle[0].friction_angle, 89);
  EXPECT_EQ(settle[1].cohesion, 2000);
  EXPECT_EQ(settle[1].tensile_strength, 5);
  EXPECT_EQ(settle[1].between, scene.joints[1].between);
  EXPECT_EQ(excavate[0].friction_angle, 30);
  EXPECT_EQ(excavate[1].cohesion, 0);
  EXPECT_EQ(last[0].friction_angle, 30);
  EXPECT_EQ(last[0].dashpot, 0.1);
}

TEST(Stages, GlueJointsWhileTheyLast) {
  const Scene scene =
      scene_of(in_stages, {"stage.0.joints.interface.glued=true", "stage.1.joints.1.glued=true",
                           "stage.2.joints.interface.glued=false"});
  const auto glued = [&](std::size_t stage, std::size_t joint) {
    return scene.stages.at(stage).joints.at(joint).glued;
  };
  EXPECT_TRUE(glued(0, 0));
  EXPECT_FALSE(glued(0, 1));
  EXPECT_FALSE(glued(1, 0)) << "of the stage before alone";
  EXPECT_TRUE(glued(1, 1));
  EXPECT_FALSE(glued(2, 0));
  EXPECT_FALSE(scene.joints.at(0).glued);
  EXPECT_EQ(scene.stages[0].joints[0].friction_angle, 89) << "beside other keys";
}

TEST(Stages, TheJointOfASceneWithoutJointsIsCalledDefault) {
  for (const char* joint : {"default", "0"}) {
    const Scene scene = scene_of(std::string(minimal) + "[[stage]]\nsteps = 2\njoints." + joint +
                                 " = { friction_angle = 20 }\n");
    EXPECT_EQ(scene.stages[0].joints.at(0).friction_angle, 20);
    EXPECT_EQ(scene.joints.at(0).friction_angle, 0);
  }
}

TEST(Stages, CountStepsAndTimeOfTheWholeRun) {
  const Scene scene = scene_of(in_stages);
  EXPECT_EQ(scene.n_steps(), 75);
  EXPECT_DOUBLE_EQ(scene.end_time(), 50 * 0.01 + 20 * 0.005 + 5 * 0.01);
  EXPECT_EQ(scene.analysis.steps, 75);
  EXPECT_EQ(scene_of(in_stages, {"analysis.steps=3"}).analysis.steps, 75) << "not used";
  EXPECT_EQ(scene.supports[0].displacement.at(0.325, scene.end_time()), Vec2(0.05, 0));
}

TEST(Stages, HaveTheRulesOfTheAnalysisForNewmark) {
  const AnalysisOptions of_scene = scene_of(in_stages).analysis;
  EXPECT_EQ(of_scene.gamma, 0.6);
  const auto options = [](const std::vector<std::string>& settings) {
    return scene_of(in_stages, settings).stages.at(1).analysis;
  };
  EXPECT_EQ(options({}).scheme, Scheme::newmark);
  EXPECT_EQ(options({}).gamma, 0.6);
  EXPECT_EQ(options({"stage.1.scheme=newmark"}).gamma, 0.6) << "it stays what it is";
  EXPECT_EQ(options({"stage.1.gamma=0.8"}).beta, 1.3 * 1.3 / 4) << "a beta left out follows gamma";
  EXPECT_EQ(options({"stage.1.gamma=0.8", "analysis.beta=0.5"}).beta, 0.5) << "one that is written stays";
  EXPECT_EQ(options({"stage.1.beta=0.5"}).gamma, 0.6);
  EXPECT_EQ(scene_of(in_stages).stages.at(2).analysis.gamma, 0.5) << "of another scheme";
  const std::string other = replaced(in_stages, "scheme = \"newmark\"\ngamma = 0.6\n", "");
  EXPECT_EQ(scene_of(other).stages.at(1).analysis.scheme, Scheme::decaying);
  EXPECT_EQ(scene_of(other, {"stage.1.scheme=newmark", "stage.1.gamma=0.7"}).stages.at(1).analysis.gamma,
            0.7);
}

TEST(Stages, TheSchemeFollowsThePresetAndTheKinematics) {
  const std::string text =
      replaced(replaced(in_stages, "scheme = \"newmark\"\ngamma = 0.6\n", ""), "scheme = \"decaying\"\n", "");
  for (const StageDescription& stage : scene_of(text, {"analysis.preset=paper"}).stages) {
    EXPECT_EQ(stage.analysis.scheme, Scheme::dda);
    EXPECT_EQ(stage.analysis.kinematics, Kinematics::incremental);
    EXPECT_EQ(stage.analysis.cutting_factor, 0.3);
  }
}

TEST(Stages, RefuseOfAJointWhatItsOtherKeysExclude) {
  const auto problem = [](const std::string& joint, const std::string& change) {
    const SceneReading reading = read_scene_text(std::string(minimal) + "[[joint]]\n" + joint +
                                                     "[[stage]]\nsteps = 1\njoints.0 = { " + change + " }\n",
                                                 "scene.toml");
    return all_text(reading.problems);
  };
  const std::string rises = "friction_angle = 30\ndilation_angle = 10\ndilation_slip = 1\n",
                    soft = "normal_stiffness = 1e9\nshear_stiffness = 1e9\n";
  for (const char* key : {"friction_angle", "residual_friction_angle"}) {
    EXPECT_NE(problem(rises, std::string(key) + " = 9").find("'dilation_angle' = '10' is larger than"),
              std::string::npos);
    EXPECT_EQ(problem(rises, std::string(key) + " = 11"), "");
  }
  EXPECT_NE(problem(soft, "restitution = 0.5").find("'restitution' of a joint that has a stiffness"),
            std::string::npos);
  EXPECT_EQ(problem(soft, "dashpot = 0.5"), "");
}

TEST(Stages, MayRemoveWhatIsHeldLoadedOrWatched) {
  EXPECT_EQ(scene_of(in_stages).monitors[0].block, 1) << "removed by the second stage";
  EXPECT_EQ(
      scene_of(in_stages, {"stage.2.remove=[\"beam\", \"base\"]", "stage.1.remove=[]"}).stages.at(2).removed,
      (std::vector<int>{2, 0}));
}

TEST(Stages, BringBlocksLoadsAndBolts) {
  std::string more(in_stages);
  more.insert(more.find("[[stage]]"),
              "[[load]]\nname = \"push\"\ntype = \"point\"\nblock = \"beam\"\nat = [1, 1.5]\n"
              "force = [1, 0]\n");
  const Scene scene = scene_of(more, {"stage.0.remove=[]", "stage.1.remove=[]", "stage.1.add=[\"push\"]",
                                      "stage.2.remove=[]", "stage.2.add=[\"beam\"]"});
  EXPECT_EQ(scene.stages[1].loads.size(), 1u);
  EXPECT_EQ(scene.stages[2].added.size(), 1u);
  std::ostringstream text;
  write_scene(text, scene);
  const Scene again = scene_of(text.str());
  EXPECT_EQ(again.stages[1].loads, scene.stages[1].loads);
  EXPECT_EQ(again.stages[2].added, scene.stages[2].added);
  const auto refused = [&](const std::vector<std::string>& settings, const std::string& words) {
    const SceneReading reading = read_scene_text(more, "scene.toml", settings);
    ASSERT_FALSE(reading.scene) << words;
    EXPECT_NE(reading.problems[0].text().find(words), std::string::npos) << reading.problems[0].text();
  };
  refused({"stage.1.add=[\"pusch\"]"}, "unknown block, bolt or load 'pusch'");
  refused({"stage.1.add=[\"push\"]", "stage.2.add=[\"push\"]"}, "load 'push' is there since stage");
  refused({"stage.1.remove=[\"beam\"]", "stage.2.add=[\"push\"]"},
          "load 'push' is on block 'beam', which is gone");
  refused({"stage.1.remove=[\"beam\"]", "stage.2.remove=[]", "stage.2.add=[\"beam\"]"},
          "block 'beam' is not there yet");
}

TEST(Stages, AreWrittenAndReadBack) {
  const std::vector<std::string> all[] = {
      {},
      {"analysis.steps=3"},
      {"stage.1.scheme=backward_euler", "stage.1.cutting_factor=0.1", "stage.1.max_displacement_ratio=0.2"},
      {"stage.settle.gamma=0.9", "stage.settle.beta=0.7", "stage.1.damping={ mass = 1, stiffness = 2 }"},
      {"analysis.preset=paper", "stage.2.scheme=dda"},
      {"stage.0.until={ kinetic = 1e-8, displacement = 1e-6 }", "stage.1.until.kinetic=1e-7",
       "stage.2.until={ displacement = 1 }"},
      {"joint.interface.name=\"two words, 2\"", "stage.settle.joints={}", "stage.2.joints={}",
       "stage.1.joints.\"two words, 2\".cohesion=7"},
      {"stage.0.joints.interface.glued=true", "stage.1.joints.1.glued=true"}};
  for (const std::vector<std::string>& settings : all) {
    const Scene scene = scene_of(in_stages, settings), again = scene_of(written(scene));
    EXPECT_EQ(written(scene), written(again));
    ASSERT_EQ(again.stages.size(), scene.stages.size());
    EXPECT_EQ(again.analysis.steps, scene.analysis.steps);
    EXPECT_EQ(again.end_time(), scene.end_time());
    for (std::size_t s = 0; s < scene.stages.size(); ++s) {
      const StageDescription &a = scene.stages[s], &b = again.stages[s];
      EXPECT_EQ(a.name, b.name);
      EXPECT_EQ(a.analysis.mode, b.analysis.mode);
      EXPECT_EQ(a.analysis.steps, b.analysis.steps);
      EXPECT_EQ(a.analysis.time_step, b.analysis.time_step);
      EXPECT_EQ(a.analysis.max_displacement_ratio, b.analysis.max_displacement_ratio);
      EXPECT_EQ(a.analysis.gravity, b.analysis.gravity);
      EXPECT_EQ(a.analysis.scheme, b.analysis.scheme);
      EXPECT_EQ(a.analysis.kinematics, b.analysis.kinematics);
      EXPECT_EQ(a.analysis.beta, b.analysis.beta);
      EXPECT_EQ(a.analysis.gamma, b.analysis.gamma);
      EXPECT_EQ(a.analysis.damping.mass, b.analysis.damping.mass);
      EXPECT_EQ(a.analysis.damping.stiffness, b.analysis.damping.stiffness);
      EXPECT_EQ(a.analysis.cutting_factor, b.analysis.cutting_factor);
      EXPECT_EQ(a.reset_displacements, b.reset_displacements);
      EXPECT_EQ(a.until, b.until);
      EXPECT_EQ(a.removed, b.removed);
      ASSERT_EQ(a.joints.size(), b.joints.size());
      for (std::size_t j = 0; j < a.joints.size(); ++j) {
        EXPECT_EQ(a.joints[j].friction_angle, b.joints[j].friction_angle);
        EXPECT_EQ(a.joints[j].cohesion, b.joints[j].cohesion);
        EXPECT_EQ(a.joints[j].tensile_strength, b.joints[j].tensile_strength);
        EXPECT_EQ(a.joints[j].restitution, b.joints[j].restitution);
        EXPECT_EQ(a.joints[j].dashpot, b.joints[j].dashpot);
        EXPECT_EQ(a.joints[j].glued, b.joints[j].glued);
        EXPECT_EQ(a.joints[j].between, b.joints[j].between);
      }
    }
  }
}

TEST(Stages, OfASceneMadeByAProgramAreWrittenToo) {
  Scene scene = scene_of(minimal);
  scene.joints.at(0).name = "a \"quoted\" name, \u00e9";
  scene.stages.push_back(scene.stage("one"));
  scene.stages[0].analysis.steps = 7;
  scene.stages[0].joints.at(0).cohesion = 3;
  scene.stages.push_back(scene.stage(""));
  const Scene again = scene_of(written(scene));
  EXPECT_EQ(written(again), written(scene));
  EXPECT_EQ(again.n_steps(), 8);
  EXPECT_EQ(again.analysis.steps, 8);
  EXPECT_EQ(again.stages[0].joints.at(0).cohesion, 3);
  EXPECT_EQ(again.stages[1].joints.at(0).cohesion, 0);
}

TEST(Stages, AreSetByNameOrIndex) {
  const auto joint = [](const char* setting, int stage, int index) {
    return scene_of(in_stages, {setting}).stages.at(stage).joints.at(index);
  };
  EXPECT_EQ(scene_of(in_stages, {"stage.settle.steps=20"}).stages.at(0).analysis.steps, 20);
  EXPECT_EQ(scene_of(in_stages, {"stage.2.time_step=1 ms"}).stages.at(2).analysis.time_step, 1e-3);
  EXPECT_EQ(scene_of(in_stages, {"stage.1.damping.stiffness=3"}).stages.at(1).analysis.damping.mass, 0.5);
  EXPECT_EQ(scene_of(in_stages, {"stage.1.remove.1=beam"}).stages.at(1).removed, (std::vector<int>{1, 2}));
  EXPECT_EQ(joint("stage.0.joints.interface.friction_angle=31 deg", 0, 0).friction_angle, 31) << "replaced";
  EXPECT_EQ(joint("stage.0.joints.interface.dashpot=0.3", 0, 0).friction_angle, 89) << "added beside another";
  EXPECT_EQ(joint("stage.2.joints.1.cohesion=4", 2, 1).cohesion, 4) << "another joint";
  EXPECT_EQ(joint("stage.excavate.joints.interface.cohesion=4", 1, 0).cohesion, 4) << "the first one";
  EXPECT_EQ(joint("stage.excavate.joints.1.cohesion=4", 1, 1).cohesion, 4) << "the first one, by its index";
}

TEST(Stages, BadSettingsAreNamed) {
  for (const auto& [setting, words] :
       {std::pair{"stage.setle.steps=3", "did you mean 'settle'?"}, std::pair{"stage.3.steps=3", "0 to 2"},
        std::pair{"stage.settle.preset=paper", "belongs to the whole run"},
        std::pair{"stage.settle.method=classic", "unknown 'method'"},
        std::pair{"stage.1.joints.interfaec.cohesion=3", "unknown joint 'interfaec'"},
        std::pair{"stage.1.joints.interface.cohesion=x", "'cohesion' = 'x'"},
        std::pair{"stage.1.joints.interfaec.glued=true", "unknown joint 'interfaec'"},
        std::pair{"stage.1.joints.interface.glued=1", "'glued'"},
        std::pair{"joint.interface.glued=true", "'glued' in [[joint]] belongs to a stage"},
        std::pair{"stage.1.joints.interface.x=3", "unknown key 'x' in 'joints.interface'"},
        std::pair{"stage.1.joints.0=3", "'joints' is not in the scene"},
        std::pair{"stage.1.remove.2=3", "2 elements"},
        std::pair{"stage.1.remove.1=pillar", "stands twice"}}) {
    const SceneReading reading = read(in_stages, {setting});
    ASSERT_EQ(reading.problems.size(), 1u) << setting << '\n' << all_text(reading.problems);
    EXPECT_EQ(reading.problems[0].file, std::string("--set ") + setting);
    EXPECT_NE(reading.problems[0].text().find(words), std::string::npos) << reading.problems[0].text();
  }
}

TEST(Stages, NoneAtAllNeedTheStepsOfTheAnalysis) {
  const SceneReading reading = read(replaced(minimal, "[analysis]\nsteps = 1", "stage = []\n[analysis]"));
  ASSERT_EQ(reading.problems.size(), 1u) << all_text(reading.problems);
  EXPECT_NE(reading.problems[0].text().find("missing key 'steps' in [analysis]"), std::string::npos);
}

TEST(Stages, SayNothingAgainOfWhatIsWrongWithTheAnalysis) {
  for (const char* setting : {"analysis.beta=0.25", "analysis.kinematics=incremental", "analysis.gamma=x",
                              "analysis.scheme=x", "contact.method=classic"}) {
    const SceneReading reading =
        read(replaced(in_stages, "scheme = \"decaying\"\n", ""), {setting, "joint.0.restitution=0.5"});
    EXPECT_LE(reading.problems.size(), 1u) << all_text(reading.problems);
  }
}

/// A lining that takes the place of rock that is gone by then.
TEST(Stages, MayPutABlockWhereAnotherOneWas) {
  const std::string lining =
      "[[block]]\nname = \"lining\"\nmaterial = \"rock\"\nvertices = [[1, 0], [2, 0], [2, 1], [1, 1]]\n";
  const Scene scene = scene_of(std::string(in_stages) + lining, {"stage.1.add=[\"lining\"]"});
  EXPECT_EQ(scene.stages[1].added, (std::vector<int>{4}));
  const SceneReading too_early = ddacontact::read_scene_text(std::string(in_stages) + lining, "scene.toml",
                                                             {"stage.0.add=[\"lining\"]"});
  ASSERT_EQ(too_early.problems.size(), 1u);
  EXPECT_NE(too_early.problems[0].text().find("overlaps block 'pillar'"), std::string::npos);
  const SceneReading stressed = ddacontact::read_scene_text(
      std::string(in_stages) + lining + "[initial_stress]\nstress = [-1e6, -1e6, 0]\n", "scene.toml",
      {"stage.1.add=[\"lining\"]"});
  ASSERT_EQ(stressed.problems.size(), 1u);
  EXPECT_EQ(stressed.problems[0].severity, ddacontact::Problem::Severity::warning);
  EXPECT_NE(stressed.problems[0].text().find("comes in with the stress of [initial_stress]"),
            std::string::npos);
}

}  // namespace
