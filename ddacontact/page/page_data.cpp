#include <ddacontact/page/page_data.hpp>

#include <ddacontact/page/byte_text.hpp>
#include <ddacontact/page/page_moments.hpp>
#include <ddacontact/picture/colour.hpp>
#include <polyfem/io/zlib_stream.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>

namespace ddacontact {

namespace {

constexpr std::size_t frames_of_chunk = 8;
constexpr Index places_of_chunk = 1'000'000;
constexpr std::size_t large_page = 30'000'000;  // numbers: about 20 MB
constexpr int n_colours = 129;
constexpr std::size_t most_points = 2000;  // of a curve

using Json = nlohmann::json;

/// To six digits: enough to be drawn and read.
double rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return std::isfinite(value) ? std::strtod(text, nullptr) : 0;
}

Json colours() {
  Json tables{{"diverging", Json::array()},
              {"sequential", Json::array()},
              {"kinds", Json::array()},
              {"lines", Json::array()}};
  for (int k = 0; k < n_colours; ++k) {
    const double t = static_cast<double>(k) / (n_colours - 1);
    tables["diverging"].push_back(hex(diverging_colour(2 * t - 1)));
    tables["sequential"].push_back(hex(sequential_colour(t)));
  }
  for (int k = 0; k < 8; ++k) tables["kinds"].push_back(hex(kind_colour(k)));
  for (int k = 0; k < 6; ++k) tables["lines"].push_back(hex(line_colour(k)));
  return tables;
}

Json history_json(const PageHistory& history) {
  Json times = Json::array(), values = Json::array();
  const std::size_t n = history.times.size(), stride = n / most_points + 1;
  for (std::size_t k = 0; k < n; k += stride) {
    const std::size_t row = k + stride >= n ? n - 1 : k;  // the last row is always there
    times.push_back(rounded(history.times[row]));
    values.push_back(rounded(history.values[row]));
  }
  return {{"name", history.name},
          {"unit", history.unit},
          {"group", history.group},
          {"times", times},
          {"values", values}};
}

Json story_json(const PageStory& story) {
  Json histories = Json::array();
  for (const PageHistory& history : story.histories) histories.push_back(history_json(history));
  return {{"title", story.title},
          {"program", story.program},
          {"verdict", story.verdict},
          {"blockNames", story.block_names},
          {"histories", histories}};
}

Json ranges_json(const PageRanges& ranges) {
  Json of_fields = Json::object();
  for (const auto& [field, range] : ranges.of_fields())
    of_fields[description(field).name] = {range.all.low, range.all.high, range.robust.low, range.robust.high};
  return of_fields;
}

}  // namespace

void PageBuilder::add(Frame frame) {
  if (moments_.empty()) {
    arrays_ = arrays_of(frame);
    const auto n_numbers = static_cast<std::size_t>(4 * frame.position.cols() + 9 * frame.n_cells());
    arrays_.is_large = n_frames_ * n_numbers > large_page;
    material_names_ = frame.material_names;
    centre_ = (frame.position.rowwise().minCoeff() + frame.position.rowwise().maxCoeff()) / 2;
  }
  const bool fits = shape_ && shape_->fits(frame);
  if (!fits || open_.size() == frames_of_chunk ||
      static_cast<Index>(open_.size() + 1) * frame.position.cols() > places_of_chunk)
    close_chunk();
  if (!fits) {
    shape_ = std::make_unique<PageShape>(frame);
    data_.shapes.push_back(base64(polyfem::zlib_stream(shape_->bytes(frame, centre_))));
  }
  moments_.emplace_back(frame.step, frame.time);
  open_.push_back(page_frame(std::move(frame)));
  ranges_.see(open_.back(), arrays_);
}

void PageBuilder::close_chunk() {
  if (open_.empty()) return;
  data_.chunks.push_back(base64(polyfem::zlib_stream(moments_bytes(open_, *shape_, arrays_))));
  chunks_.push_back({static_cast<int>(data_.shapes.size()) - 1, static_cast<int>(open_.size())});
  open_.clear();
}

PageData PageBuilder::finish(const PageStory& story) {
  close_chunk();
  Json head = story_json(story);
  head["centre"] = {centre_.x(), centre_.y()};
  head["arrays"] = {
      {"displacement", arrays_.displacement}, {"velocity", arrays_.velocity}, {"stress", arrays_.stress}};
  head["frames"] = Json::array();
  for (const auto& [step, time] : moments_) head["frames"].push_back({step, time});
  head["chunks"] = Json::array();
  for (const Chunk& chunk : chunks_) head["chunks"].push_back({chunk.shape, chunk.n_frames});
  head["ranges"] = ranges_json(ranges_);
  head["force"] = ranges_.force();
  head["materials"] = material_names_;
  head["colours"] = colours();
  data_.head = head.dump(-1, ' ', true, Json::error_handler_t::replace);
  return std::move(data_);
}

}  // namespace ddacontact
