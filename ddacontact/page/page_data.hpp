/// \file All that a page shows of a run, as texts to be put into it.
#pragma once

#include <ddacontact/page/page_ranges.hpp>
#include <ddacontact/page/page_shape.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace ddacontact {

/// A curve over time.
struct PageHistory {
  std::string name, unit;
  std::string group;  ///< curves of one group share a diagram
  std::vector<double> times, values;
};

/// What a page says of a run beside its frames.
struct PageStory {
  std::string title, program;
  std::vector<std::string> verdict;  ///< lines: how the run ended
  std::vector<std::string> block_names;
  std::vector<PageHistory> histories;
};

/// The parts of a page. Shapes and chunks are zlib streams in Base64 of what PageShape::bytes and
/// `moments_bytes` give.
struct PageData {
  std::string head;  ///< JSON: the story, which frames there are and where, ranges, colours
  std::vector<std::string> shapes, chunks;
};

/// Takes frames in the order of time. Frames of one shape go together into a chunk, a few at a time, so that
/// a page need not inflate all of them to show one.
class PageBuilder {
 public:
  /// \param[in] n_frames  how many will be added: a page of many numbers keeps them to fewer digits
  explicit PageBuilder(std::size_t n_frames) : n_frames_(n_frames) {}

  /// The first frame decides which arrays the page holds, and its centre.
  void add(Frame frame);
  /// The page of all frames added; at least one.
  PageData finish(const PageStory& story);

 private:
  struct Chunk {
    int shape = 0, n_frames = 0;
  };
  void close_chunk();

  std::size_t n_frames_;
  PageArrays arrays_;
  Vec2 centre_{0, 0};
  std::vector<std::string> material_names_;
  std::unique_ptr<PageShape> shape_;
  std::vector<PageFrame> open_;  ///< the frames of the chunk that is being filled
  std::vector<std::pair<long, double>> moments_;
  std::vector<Chunk> chunks_;
  PageRanges ranges_;
  PageData data_;
};

}  // namespace ddacontact
