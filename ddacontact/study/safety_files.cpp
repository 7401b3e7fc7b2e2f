#include <ddacontact/study/safety_files.hpp>

#include <ddacontact/output/output_error.hpp>
#include <ddacontact/picture/chart.hpp>
#include <ddacontact/scene/text.hpp>
#include <ddacontact/study/scene_picture.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/io/write_error.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace ddacontact {

namespace {

std::filesystem::path made(std::filesystem::path directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) throw OutputError("cannot make \"" + directory.string() + "\": " + error.message());
  return directory;
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw polyfem::write_error(path);
}

const Colour first_colour{178, 24, 43}, moved_colour{244, 165, 130}, removed_colour{255, 255, 255};

/// Taken out at the start of any stage.
std::vector<int> removed_blocks(const Scene& scene) {
  std::vector<int> removed;
  for (const StageDescription& stage : scene.stages)
    removed.insert(removed.end(), stage.removed.begin(), stage.removed.end());
  return removed;
}

/// JSON has no infinity.
nlohmann::ordered_json factor_or_null(double factor) {
  return factor > 0 && std::isfinite(factor) ? nlohmann::ordered_json(factor) : nlohmann::ordered_json();
}

}  // namespace

std::string word_of(Verdict verdict) {
  return verdict == Verdict::rests ? "rests" : verdict == Verdict::moves ? "moves" : "stopped";
}

std::string bonds_of(const Scene& scene, const std::vector<int>& joints) {
  bool ductile = false, brittle = false;
  for (const int j : joints) {
    const Joint& joint = scene.stages.back().joints[j];
    if (joint.cohesion > 0 || joint.tensile_strength > 0) (joint.ductile ? ductile : brittle) = true;
  }
  return ductile && brittle ? "mixed" : ductile ? "ductile" : brittle ? "brittle" : "none";
}

MovedPart moved_part(const Scene& scene, const StrengthTrial& trial) {
  const std::vector<int> removed = removed_blocks(scene);
  MovedPart part;
  double of_moved = 0, of_all = 0;
  for (int b = 0; b < static_cast<int>(scene.blocks.size()); ++b) {
    if (scene.blocks[b].fixed || std::ranges::count(removed, b) > 0) continue;
    const double area = std::abs(polyfem::signed_area(scene.blocks[b].vertices));
    ++part.of_blocks;
    of_all += area;
    if (!std::ranges::binary_search(trial.moved_blocks, b)) continue;
    ++part.blocks;
    of_moved += area;
  }
  if (of_all > 0) part.area_share = of_moved / of_all;
  return part;
}

SafetyFiles::SafetyFiles(std::filesystem::path directory, Scene scene, std::vector<int> joints)
    : directory_(made(std::move(directory))),
      scene_(std::move(scene)),
      joints_(std::move(joints)),
      csv_((directory_ / "safety.csv").string(),
           "factor,verdict,max_displacement,kinetic,unbalanced,time,steps,first_block,reason") {}

void SafetyFiles::add(const StrengthTrial& trial) {
  trials_.push_back(trial);
  const std::string first = trial.first_block < 0 ? "" : scene_.block_name(trial.first_block);
  csv_.row(trial.factor, word_of(trial.verdict), trial.max_displacement, trial.kinetic, trial.unbalanced,
           trial.time, trial.steps, first, trial.reason);
  csv_.mark();
}

const StrengthTrial* SafetyFiles::first_to_move() const {
  const StrengthTrial* first = nullptr;
  for (const StrengthTrial& trial : trials_)
    if (trial.verdict == Verdict::moves && (!first || trial.factor < first->factor)) first = &trial;
  return first;
}

void SafetyFiles::finish(const FactorBracket& bracket, const VariantTrials& variants, double tolerance,
                         const std::string& unsettled, double wall_seconds) {
  csv_.close();
  write_json(bracket, variants, tolerance, unsettled, wall_seconds);
  if (trials_.empty()) return;
  draw_curve();
  if (const StrengthTrial* first = first_to_move()) draw_moved(*first);
}

std::vector<std::string> SafetyFiles::names_of_joints() const {
  std::vector<std::string> names;
  for (const int j : joints_)
    names.push_back(scene_.joints[j].name.empty() ? std::to_string(j) : scene_.joints[j].name);
  return names;
}

void SafetyFiles::write_json(const FactorBracket& bracket, const VariantTrials& variants, double tolerance,
                             const std::string& unsettled, double wall_seconds) const {
  double time = 0;
  long steps = 0;
  for (const StrengthTrial& trial : trials_) {
    time += trial.time;
    steps += trial.steps;
  }
  const std::string stopped = !bracket.stopped ? "" : trials_.empty() ? unsettled : trials_.back().reason;
  nlohmann::ordered_json json = {{"status", bracket.stopped ? "stopped" : "completed"},
                                 {"factor_low", factor_or_null(bracket.low)},
                                 {"factor_high", factor_or_null(bracket.high)},
                                 {"tolerance", tolerance},
                                 {"joints", names_of_joints()},
                                 {"cohesion", bonds_of(scene_, joints_)},
                                 {"trials", trials_.size()},
                                 {"steps_completed", steps},
                                 {"time", time},
                                 {"wall_seconds", wall_seconds},
                                 {"settled", unsettled.empty()},
                                 {"reason", stopped},
                                 {"stopped", stopped}};
  for (const StrengthTrial& trial : trials_) {
    if (trial.factor == bracket.low) json["decided_low"] = trial.reason;
    if (trial.factor == bracket.high) json["decided_high"] = trial.reason;
  }
  nlohmann::ordered_json with_rounding = {
      {"corner_rounding", nullptr}, {"factor", nullptr}, {"verdict", nullptr}};
  if (const auto& rounded = variants.rounded)
    with_rounding = {{"corner_rounding", rounded->rounding},
                     {"factor", rounded->trial.factor},
                     {"verdict", word_of(rounded->trial.verdict)}};
  json["rounded_corners"] = with_rounding;
  json["poisson_0"] = {{"factor", nullptr}, {"verdict", nullptr}};
  if (const auto& trial = variants.without_swelling)
    json["poisson_0"] = {{"factor", trial->factor}, {"verdict", word_of(trial->verdict)}};
  if (const StrengthTrial* first = first_to_move(); first && first->first_block >= 0) {
    json["max_displacement"] = first->max_displacement;
    json["kinetic"] = first->kinetic;
    json["first_block"] = scene_.block_name(first->first_block);
    std::vector<std::string> moved;
    for (const int b : first->moved_blocks) moved.push_back(scene_.block_name(b));
    json["moved_blocks"] = moved;
    const MovedPart part = moved_part(scene_, *first);
    json["moved_count"] = part.blocks;
    json["moved_area_share"] = part.area_share;
  } else {
    for (const char* key :
         {"max_displacement", "kinetic", "first_block", "moved_blocks", "moved_count", "moved_area_share"})
      json[key] = nullptr;
  }
  write(directory_ / "safety.json",
        json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + '\n');
}

void SafetyFiles::draw_curve() const {
  std::vector<StrengthTrial> sorted = trials_;
  std::ranges::sort(sorted, {}, &StrengthTrial::factor);
  Series curve{.name = "largest displacement", .x = {}, .y = {}, .dots = true};
  for (const StrengthTrial& trial : sorted) {
    if (trial.verdict == Verdict::stopped) continue;
    curve.x.push_back(trial.factor);
    curve.y.push_back(trial.max_displacement);
  }
  const Chart chart{.x_symbol = {"F", "", ""},
                    .y_symbol = {"u", "max", ""},
                    .x_unit = "",
                    .y_unit = "m",
                    .series = {curve}};
  write(directory_ / "safety.svg", draw({chart}, {.title = "Displacement against the factor of reduction"}));
}

void SafetyFiles::draw_moved(const StrengthTrial& trial) const {
  ScenePictureOptions options;
  if (const std::vector<int> removed = removed_blocks(scene_); !removed.empty())
    options.marks.push_back({removed, removed_colour, "taken out"});
  const std::string factor = scene_format::rounded(trial.factor);
  options.marks.push_back({trial.moved_blocks, moved_colour, "moves at F = " + factor});
  if (trial.first_block >= 0) options.marks.push_back({{trial.first_block}, first_colour, "moves furthest"});
  Scene shown = scene_;
  shown.title = "What moves first, drawn where it stood";
  write(directory_ / "safety_moved.svg", draw(shown, options));
}

}  // namespace ddacontact
