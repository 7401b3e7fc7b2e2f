#include "result.hpp"

#include "call_error.hpp"

#include <fmt/format.h>
#include <ddacontact/output/csv_table.hpp>
#include <ddacontact/output/summary_reader.hpp>
#include <ddacontact/scene/reader.hpp>

#include <algorithm>
#include <charconv>
#include <cstdlib>

namespace dda {

namespace fs = std::filesystem;
using namespace ddacontact;

void expect_result_directory(const fs::path& directory) {
  std::error_code error;
  const fs::file_status status = fs::status(directory, error);
  if (!fs::exists(status))
    throw Error(fmt::format("cannot read \"{}\": there is no such directory", directory.string()));
  if (!fs::is_directory(status))
    throw Error(
        fmt::format("\"{}\" is a file; name the directory that \"dda run\" wrote", directory.string()));
  if (fs::exists(directory / "summary.json", error) || fs::exists(directory / "results.pvd", error)) return;
  for (const auto& [file, holds] : {std::pair{"sweep.csv", "a sweep"}, {"safety.json", "a factor of safety"}})
    if (fs::exists(directory / file, error))
      throw Error(fmt::format("\"{}\" holds {}, in \"{}\"; name the directory of one of its runs",
                              directory.string(), holds, file));
  throw Error(fmt::format("\"{}\" is not a result directory: neither summary.json nor results.pvd is there",
                          directory.string()));
}

std::optional<Scene> scene_of(const fs::path& directory) {
  return read_scene((directory / "scene.toml").string()).scene;
}

std::string name_of(const fs::path& directory) {
  fs::path path = fs::absolute(directory).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  return path.filename().string();
}

std::string title_of(const fs::path& directory, const std::optional<Scene>& scene) {
  return scene && !scene->title.empty() ? scene->title : name_of(directory);
}

std::vector<std::string> block_names(const fs::path& directory) {
  std::vector<std::string> names;
  if (const std::optional<Scene> scene = scene_of(directory)) {
    for (std::size_t b = 0; b < scene->blocks.size(); ++b)
      names.push_back(scene->block_name(static_cast<int>(b)));
    return names;
  }
  std::error_code error;
  const fs::path path = directory / "blocks.csv";
  return fs::exists(path, error) ? CsvTable(path).texts("block") : names;
}

std::vector<BoltLine> bolts_of(const fs::path& directory) {
  std::error_code error;
  const fs::path path = directory / "bolts.csv";
  if (!fs::exists(path, error)) return {};
  const CsvTable table(path);
  const std::vector<double> xa = table.numbers("xa"), ya = table.numbers("ya"), xb = table.numbers("xb"),
                            yb = table.numbers("yb"), force = table.numbers("axial_force");
  const std::vector<std::string> state = table.texts("state");
  std::vector<BoltLine> bolts;
  for (std::size_t k = 0; k < table.n_rows(); ++k)
    bolts.push_back({{xa[k], ya[k]}, {xb[k], yb[k]}, force[k], state[k]});
  return bolts;
}

Water water_at(const fs::path& directory, const Scene& scene, long step) {
  if (scene.stages.empty()) return scene.water;
  std::error_code error;
  const fs::path path = directory / "summary.json";
  const SummaryTable summary = fs::exists(path, error) ? read_summary(path) : SummaryTable{};
  double end = 0;
  for (std::size_t k = 0; k < scene.stages.size(); ++k) {
    // A stage may end before its steps are made.
    end += summary.number(fmt::format("stages.{}.steps", k)).value_or(scene.stages[k].analysis.steps);
    if (static_cast<double>(step) <= end) return scene.stages[k].water;
  }
  return scene.stages.back().water;
}

std::string steps_text(const FrameSeries& series) {
  const long first = series.front().step, last = series.back().step;
  const long stride = series.size() > 1 ? series[1].step - first : 0;
  bool even = series.size() > 4;
  for (std::size_t i = 1; i < series.size(); ++i)
    even = even && series[i].step - series[i - 1].step == stride;
  if (even)
    return fmt::format("{} to {}, every {}", first, last, stride == 1 ? "one" : std::to_string(stride));
  std::string text;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const bool shown = series.size() <= 8 || i < 4 || i + 2 >= series.size();
    if (shown)
      text += fmt::format("{}{}", text.empty() ? "" : ", ", series[i].step);
    else if (i == 4)
      text += ", ...";
  }
  return text;
}

const FrameFile& frame_of(const FrameSeries& series, const std::string& word, const fs::path& directory) {
  if (word == "last") return series.back();
  long step = 0;
  const char* end = word.data() + word.size();
  const auto [read, error] = std::from_chars(word.data(), end, step);
  if (error != std::errc() || read != end || step < 0)
    throw CallError(fmt::format("\"{}\" is no frame: give the number of a step or \"last\"", word));
  const FrameFile* nearest = &series.front();
  for (const FrameFile& frame : series)
    if (std::labs(frame.step - step) <= std::labs(nearest->step - step)) nearest = &frame;
  if (nearest->step == step) return *nearest;
  throw CallError(fmt::format("\"{}\" has no frame of step {} (nearest: {}; there are: {})",
                              directory.string(), step, nearest->step, steps_text(series)));
}

}  // namespace dda
