/// \file `dda view` from outside; tests/viewer/ opens its pages in a browser.
#include "program.hpp"

namespace {

using namespace support;

class View : public Program {
 protected:
  View() {
    const std::string scene = "'" POLYDDA_EXAMPLES "/paper/arch_friction30.toml'";
    EXPECT_EQ(dda("run " + scene + " -o result --steps 10 --quiet"), 0) << err_;
  }
  std::string page(const std::string& name) const { return read_file(directory_ / name); }
};

TEST_F(View, WritesOnePageThatNeedsNothingElse) {
  ASSERT_EQ(dda("view result -o page.html"), 0) << err_;
  EXPECT_TRUE(out_.empty());
  const std::string text = page("page.html");
  for (const char* part : {"<!doctype html>", "id=\"head\"", "id=\"shape0\"", "id=\"chunk0\"",
                           "id=\"chunk1\"", "Arch bridge", "\"verdict\":[\"completed, 10 steps"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
  for (const char* link : {"http://", "https://", "<link", " src=", "<!--first data-->"})
    EXPECT_EQ(text.find(link), std::string::npos) << link;
}

TEST_F(View, ShowsWhatTheFramesHold) {
  ASSERT_EQ(dda("run '" POLYDDA_EXAMPLES
                "/paper/arch_friction30.toml' -o few --steps 2 --quiet --set 'output.fields=[\"velocity\"]'"),
            0)
      << err_;
  ASSERT_EQ(dda("view few -o few.html"), 0) << err_;
  EXPECT_NE(page("few.html").find("\"arrays\":{\"displacement\":false,\"stress\":false,\"velocity\":true}"),
            std::string::npos);
}

TEST_F(View, GivesTheSameBytesEveryTime) {
  ASSERT_EQ(dda("view result -o a.html"), 0) << err_;
  ASSERT_EQ(dda("view result -o b.html"), 0) << err_;
  EXPECT_EQ(page("a.html"), page("b.html"));
}

TEST_F(View, WrongCallsAreRefusedWithACure) {
  EXPECT_EQ(dda("view result -o page.svg"), 2);
  EXPECT_NE(err_.find("must end in .html"), std::string::npos) << err_;
  EXPECT_EQ(dda("view nowhere -o page.html"), 4);
  EXPECT_NE(err_.find("there is no such directory"), std::string::npos) << err_;
  EXPECT_EQ(dda("view result -o no/such/page.html"), 4);
  EXPECT_NE(err_.find("cannot write"), std::string::npos) << err_;
}

}  // namespace
