#include "info_result.hpp"

#include "result.hpp"

#include <ddacontact/output/csv_table.hpp>
#include <ddacontact/picture/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace dda {

namespace fs = std::filesystem;
using namespace ddacontact;

namespace {

/// The place of the largest of some numbers.
std::size_t at_largest(const std::vector<double>& values) {
  return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

std::vector<double> lengths(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<double> lengths;
  for (std::size_t i = 0; i < x.size(); ++i) lengths.push_back(std::hypot(x[i], y[i]));
  return lengths;
}

/// The weight of all blocks, a vector; nothing without the scene.
std::optional<Vec2> weight(const std::optional<Scene>& scene, const fs::path& directory) {
  if (!scene) return std::nullopt;
  const CsvTable blocks(directory / "blocks.csv");
  const std::vector<double> areas = blocks.numbers("area"), ratios = blocks.numbers("area_ratio");
  if (areas.size() != scene->blocks.size()) return std::nullopt;
  double mass = 0;
  for (std::size_t b = 0; b < areas.size(); ++b)
    mass +=
        scene->materials[static_cast<std::size_t>(scene->blocks[b].material)].density * areas[b] / ratios[b];
  return mass * scene->analysis.gravity;
}

}  // namespace

void tell_models(Answer& answer, const fs::path& directory) {
  answer.topic("models");
  std::map<std::string, int> counts;
  for (const std::string& model : CsvTable(directory / "blocks.csv").texts("model")) ++counts[model];
  std::string text;
  for (const auto& [model, count] : counts)
    text += (text.empty() ? "" : ", ") + plural(count, "block", "blocks") + " " + model;
  if (!text.empty()) answer.line(text);
}

void tell_motion(Answer& answer, const fs::path& directory) {
  answer.topic("motion");
  const CsvTable vertices(directory / "vertices.csv");
  if (vertices.n_rows() == 0) return;
  const std::vector<double> moved = lengths(vertices.numbers("ux"), vertices.numbers("uy"));
  const std::size_t i = at_largest(moved);
  if (moved[i] > 0)
    answer.line(fmt::format("largest displacement {}: block {}, vertex {}", quantity_text(moved[i], "m"),
                            vertices.texts("block")[i], vertices.texts("vertex")[i]));
  else
    answer.line("no displacement at the end");
}

void tell_stress(Answer& answer, const fs::path& directory) {
  answer.topic("stress");
  const CsvTable blocks(directory / "blocks.csv");
  if (blocks.n_rows() == 0) return;
  const std::vector<std::string> names = blocks.texts("block");
  std::vector<double> s1 = blocks.numbers("s1_max"), s2 = blocks.numbers("s2_min");
  for (double& value : s2) value = -value;
  const std::size_t i = at_largest(s1), j = at_largest(s2);
  answer.line(fmt::format("largest principal stress {} in block {}", quantity_text(s1[i], "Pa"), names[i]));
  answer.line(fmt::format("smallest {} in block {} (tension positive, at integration points)",
                          quantity_text(-s2[j], "Pa"), names[j]));
}

void tell_contacts(Answer& answer, const SummaryTable& summary, const fs::path& directory) {
  answer.topic("contacts");
  const CsvTable contacts(directory / "contacts.csv");
  std::map<std::string, int> states;
  for (const std::string& state : contacts.texts("state")) ++states[state];
  answer.line(fmt::format("at the end {} stick, {} slip, {} just opened", states["stick"], states["slip"],
                          states["open"]));
  if (contacts.n_rows() > 0) {
    const std::vector<double> force =
        lengths(contacts.numbers("normal_force"), contacts.numbers("shear_force"));
    const std::size_t i = at_largest(force);
    answer.line(fmt::format("largest force {}: block {}, vertex {} on block {}",
                            quantity_text(force[i], "N/m"), contacts.texts("block_a")[i],
                            contacts.texts("vertex")[i], contacts.texts("block_b")[i]));
  }
  const auto penetration = summary.number("max_penetration");
  if (!penetration) return;
  const std::vector<double> areas = CsvTable(directory / "blocks.csv").numbers("area");
  std::string text = "deepest penetration " + quantity_text(*penetration, "m");
  if (!areas.empty() && *penetration > 0) {
    const double size = std::sqrt(*std::min_element(areas.begin(), areas.end()));
    text += fmt::format(", {} of the smallest block's size ({})", number_text(*penetration / size, 2),
                        quantity_text(size, "m"));
  }
  answer.line(text);
}

void tell_reactions(Answer& answer, const std::optional<Scene>& scene, const fs::path& directory) {
  answer.topic("reactions");
  std::error_code error;
  if (!fs::exists(directory / "supports.csv", error)) return;
  const CsvTable supports(directory / "supports.csv");
  if (supports.n_rows() == 0) return answer.line("nothing is held");
  Vec2 sum(0, 0);
  for (const double force : supports.numbers("fx")) sum.x() += force;
  for (const double force : supports.numbers("fy")) sum.y() += force;
  std::string text =
      fmt::format("sum ({}, {})", quantity_text(sum.x(), "N/m", 4), quantity_text(sum.y(), "N/m", 4));
  if (const auto w = weight(scene, directory)) {
    text += fmt::format("; the blocks weigh {}", quantity_text(w->norm(), "N/m", 4));
    if (!scene->loads.empty())
      text += " and " + plural(static_cast<double>(scene->loads.size()), "load acts", "loads act");
  }
  answer.line(text);
}

void tell_frames(Answer& answer, const fs::path& directory) {
  answer.topic("frames");
  std::error_code error;
  if (!fs::exists(directory / "results.pvd", error)) return answer.line("none");
  const FrameSeries series = read_series(directory);
  answer.line(
      fmt::format("{}: {} {}", series.size(), series.size() == 1 ? "step" : "steps", steps_text(series)));
}

void tell_files(Answer& answer, const fs::path& directory) {
  answer.topic("files");
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end; entry.increment(error))
    names.push_back(entry->path().filename().string() + (entry->is_directory(error) ? "/" : ""));
  std::sort(names.begin(), names.end());
  answer.line(fmt::format("{}", fmt::join(names, ", ")));
}

}  // namespace dda
