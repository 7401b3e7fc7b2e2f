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

TEST(RoundingCheck, ItsAdviceIsTaken) {
  const std::string text = said({"contact.corner_rounding=0.6"}), at_most = "write at most ";
  const std::size_t number = text.find(at_most) + at_most.size();
  EXPECT_EQ(said({"contact.corner_rounding=" + text.substr(number, text.find(',', number) - number)}), "");
}

TEST(RoundingCheck, RefusesTheClassicMethodAndThePreset) {
  for (const char* of : {"contact.method=classic", "analysis.preset=paper"}) {
    const std::string text = said({of, "contact.corner_rounding=0.05"});
    EXPECT_NE(text.find("'corner_rounding' = '0.05' needs the contact method 'staged'"), std::string::npos)
        << text;
  }
}

}  // namespace
