#include "frames.hpp"

#include <ddacontact/page/page_data.hpp>

#include <gtest/gtest.h>

namespace {

using namespace ddacontact;

/// How many chunks and shapes a page of the frames has.
std::pair<std::size_t, std::size_t> parts_of(const std::vector<Frame>& frames) {
  PageBuilder page(frames.size());
  for (const Frame& frame : frames) page.add(frame);
  PageStory story;
  story.title = "a title";
  const PageData data = page.finish(story);
  EXPECT_NE(data.head.find("\"a title\""), std::string::npos);
  return {data.chunks.size(), data.shapes.size()};
}

Frame moved_wall(double by) {
  Frame frame = support::wall(3, 2);
  frame.displacement.setConstant(by);
  frame.position.array() += by;
  return frame;
}

TEST(PageData, FramesOfOneShapeShareIt) {
  std::vector<Frame> frames;
  for (int k = 0; k < 20; ++k) frames.push_back(moved_wall(0.1 * k));
  EXPECT_EQ(parts_of(frames), std::pair(std::size_t{3}, std::size_t{1}));
}

TEST(PageData, AResetOfDisplacementsBeginsANewShape) {
  std::vector<Frame> frames{moved_wall(0), moved_wall(0.2), moved_wall(0.2)};
  frames[2].displacement.setZero();
  EXPECT_EQ(parts_of(frames), std::pair(std::size_t{2}, std::size_t{2}));
}

TEST(PageData, ABlockTakenOutBeginsANewShape) {
  std::vector<Frame> frames{moved_wall(0), moved_wall(0)};
  frames[1].corner_points.resize(frames[1].corner_points.size() - 4);
  frames[1].cells.pop_back();
  frames[1].strain_displacement.conservativeResize(2, frames[1].strain_displacement.cols() - 4);
  frames[1].stress_offset.setZero(3, frames[1].n_cells());
  EXPECT_EQ(parts_of(frames), std::pair(std::size_t{2}, std::size_t{2}));
}

TEST(PageData, ALargeRunTakesFewerBytesANumber) {
  Frame frame = support::wall(30, 20);
  for (Points* columns : {&frame.velocity, &frame.strain_displacement})
    *columns = 1e-3 * Points::Random(2, columns->cols());
  const auto size_of_page = [&](std::size_t n_frames) {
    PageBuilder page(n_frames);
    page.add(frame);
    return page.finish({}).chunks.at(0).size();
  };
  EXPECT_LT(size_of_page(1'000'000), 0.9 * static_cast<double>(size_of_page(1)));
}

TEST(PageRanges, LeaveSinglePeaksOut) {
  std::vector<double> values(1000, 1.0);
  values[3] = 1e6;
  EXPECT_EQ(percentile(values, 0.99), 1.0);
  EXPECT_EQ(percentile(values, 1), 1e6);
  EXPECT_EQ(percentile({1, 3}, 0.5), 2.0);
  EXPECT_EQ(percentile({}, 0.5), 0.0);
}

}  // namespace
