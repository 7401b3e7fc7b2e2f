// Newmark's scheme for stiff blocks that may turn, the explicit one with damping.
#include "example_scenes.hpp"

namespace {

using namespace example_scenes;

/// What is said of the minimal scene, whose block a wave runs through 22 times in a step, with settings.
std::string said(std::vector<std::string> settings) {
  settings.insert(settings.begin(), "material.rock.young=1e10");
  const SceneReading reading = read(minimal, settings);
  EXPECT_TRUE(reading.scene) << "a warning refuses nothing";
  return all_text(reading.problems);
}

TEST(SchemeCheck, WarnsOfNewmarkWithLittleDampingOfStiffBlocks) {
  const std::string text = said({"analysis.scheme=newmark"});
  for (const char* words :
       {"warning: ", "'0.5'", "not stable when stiff blocks turn", "0.01 s", "block 0 21.91 times",
        "(write gamma = 0.6, or scheme = \"decaying\" or \"midpoint\")"})
    EXPECT_NE(text.find(words), std::string::npos) << words << " in " << text;
  EXPECT_NE(said({"analysis.scheme=newmark", "analysis.gamma=0.59"}), "");
}

TEST(SchemeCheck, IsSilentWhereItIsStable) {
  for (const std::vector<std::string>& settings : std::vector<std::vector<std::string>>{
           {"analysis.scheme=newmark", "analysis.gamma=0.6"},
           {"analysis.scheme=newmark", "analysis.time_step=0.001"},
           {"analysis.scheme=newmark", "material.rock.young=2e9"},
           {"analysis.scheme=newmark", "analysis.kinematics=incremental"},
           {"analysis.scheme=newmark", "analysis.mode=static", "block.0.fixed=[0]"},
           {"analysis.scheme=newmark", "block.0.fixed=true"},
           {"analysis.scheme=midpoint"},
           {}})
    EXPECT_EQ(said(settings), "");
}

TEST(SchemeCheck, WarnsOfWaterByTheSchemeThatGainsEnergyInIt) {
  const auto in_water = [](const char* scheme) {
    return all_text(read(std::string(minimal) + "[water]\ntable = [[0, 1]]\n", {scheme}).problems);
  };
  EXPECT_NE(in_water("analysis.scheme=dda").find("would gain energy"), std::string::npos);
  EXPECT_EQ(in_water("analysis.scheme=decaying").find("would gain energy"), std::string::npos);
}

TEST(SchemeCheck, WarnsOfSpringsThatBlocksSinkInto) {
  EXPECT_NE(
      said({"contact.method=classic", "contact.normal_stiffness=10"}).find("sink into such soft springs"),
      std::string::npos);
  EXPECT_EQ(said({"contact.method=classic", "contact.normal_stiffness=1e9"}), "");
}

/// The block's critical step is about 2.6e-4 s: a damping stiffness of 1.3e-3 s makes it ten times shorter.
TEST(SchemeCheck, RefusesDampingThatLeavesNoExplicitStep) {
  const std::vector<std::string> settings{"material.rock.young=1e10", "analysis.scheme=explicit"};
  const auto with = [&](const char* stiffness) {
    std::vector<std::string> all = settings;
    all.push_back(std::string("analysis.damping={stiffness=") + stiffness + "}");
    return read(minimal, all);
  };
  EXPECT_TRUE(with("1.2e-3").scene);
  EXPECT_FALSE(with("1.4e-3").scene);
  const SceneReading refused = with("0.1");
  EXPECT_FALSE(refused.scene);
  const std::string text = all_text(refused.problems);
  for (const char* words : {"error: ", "'0.1' s is stable in steps below about", "by block 0",
                            "(write a stiffness of at most", "or scheme = \"decaying\")"})
    EXPECT_NE(text.find(words), std::string::npos) << words << " in " << text;
}

TEST(SchemeCheck, LooksAtEveryStage) {
  const std::string of_stage = said({"stage=[{ steps = 1 }, { steps = 1, scheme = \"newmark\" }]"});
  EXPECT_NE(of_stage.find("not stable"), std::string::npos) << of_stage;
  EXPECT_EQ(said({"analysis.scheme=newmark", "stage=[{ steps = 1, scheme = \"decaying\" }]"}), "");
}

}  // namespace
