// Rounded corners that blocks are too small for, or that the contact method does not know.
#include "example_scenes.hpp"

namespace {

using namespace example_scenes;

std::string said(const std::vector<std::string>& settings) {
  return all_text(read(minimal, settings).problems);
}

TEST(RoundingCheck, TakesWhatTheShortestEdgeAllows) {
  EXPECT_EQ(said({"contact.corner_rounding=0.05"}), "");
  EXPECT_EQ(said({"contact.corner_rounding=0"}), "");
}

TEST(RoundingCheck, RefusesWhatLeavesNothingOfAnEdge) {
  const std::string text = said({"contact.corner_rounding=0.6"});
  for (const char* words :
       {"error: ", "'corner_rounding' = '0.6'", "leaves nothing of an edge of block 0", "write at most "})
    EXPECT_NE(text.find(words), std::string::npos) << words << " in " << text;
}

TEST(RoundingCheck, WarnsWhereOtherBlocksLeaveRoom) {
  const std::string text = all_text(
      read(row_of_three, {"contact.corner_rounding=0.003",
                          "block.2.vertices=[[4,0],[6,0],[6,0.9999],[5.9999,1],[4,1]]"})
          .problems);
  EXPECT_NE(text.find("warning: 'corner_rounding' = '0.003' leaves nothing of an edge of block 'c'"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("arcs of blocks with such edges are smaller"), std::string::npos) << text;
}

TEST(RoundingCheck, ItsAdviceIsTaken) {
  for (const char* short_edge : {"0.5", "0.01", "1e-4"}) {
    const std::string vertices =
                          std::string("block.0.vertices=[[0,0],[1,0],[1,1],[") + short_edge + ",1],[0,1]]",
                      text = said({"contact.corner_rounding=0.6", vertices});
    const std::string at_most = "write at most ";
    const std::size_t number = text.find(at_most) + at_most.size();
    const std::string advice = text.substr(number, text.find(',', number) - number);
    EXPECT_GT(std::stod(advice), 0);
    EXPECT_EQ(said({"contact.corner_rounding=" + advice, vertices}), "") << short_edge;
  }
}

TEST(RoundingCheck, RefusesTheClassicMethodAndThePreset) {
  for (const char* of : {"contact.method=classic", "analysis.preset=paper"}) {
    const std::string text = said({of, "contact.corner_rounding=0.05"});
    EXPECT_NE(text.find("'corner_rounding' = '0.05' needs the contact method 'staged'"), std::string::npos)
        << text;
  }
}

}  // namespace
