#include <ddacontact/study/safety_files.hpp>

#include <ddacontact/output/output_error.hpp>
#include <ddacontact/picture/chart.hpp>

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
  if (!out) throw OutputError("cannot write \"" + path.string() + "\"");
}

/// JSON has no infinity.
nlohmann::ordered_json factor_or_null(double factor) {
  return factor > 0 && std::isfinite(factor) ? nlohmann::ordered_json(factor) : nlohmann::ordered_json();
}

}  // namespace

std::string word_of(Verdict verdict) {
  return verdict == Verdict::rests ? "rests" : verdict == Verdict::moves ? "moves" : "stopped";
}

SafetyFiles::SafetyFiles(std::filesystem::path directory, std::vector<std::string> block_names)
    : directory_(made(std::move(directory))),
      block_names_(std::move(block_names)),
      csv_((directory_ / "safety.csv").string(),
           "factor,verdict,max_displacement,kinetic,unbalanced,time,steps,first_block,reason") {}

void SafetyFiles::add(const StrengthTrial& trial) {
  trials_.push_back(trial);
  const std::string first = trial.first_block < 0 ? "" : block_names_[trial.first_block];
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

void SafetyFiles::finish(const FactorBracket& bracket, double tolerance,
                         const std::vector<std::string>& joints, const std::string& unsettled) {
  csv_.close();
  write_json(bracket, tolerance, joints, unsettled);
  draw_curve();
}

void SafetyFiles::write_json(const FactorBracket& bracket, double tolerance,
                             const std::vector<std::string>& joints, const std::string& unsettled) const {
  nlohmann::ordered_json json = {{"factor_low", factor_or_null(bracket.low)},
                                 {"factor_high", factor_or_null(bracket.high)},
                                 {"tolerance", tolerance},
                                 {"joints", joints},
                                 {"trials", trials_.size()},
                                 {"settled", unsettled.empty()},
                                 {"stopped", bracket.stopped ? trials_.back().reason : ""}};
  for (const StrengthTrial& trial : trials_) {
    if (trial.factor == bracket.low) json["decided_low"] = trial.reason;
    if (trial.factor == bracket.high) json["decided_high"] = trial.reason;
  }
  if (const StrengthTrial* first = first_to_move(); first && first->first_block >= 0) {
    json["first_block"] = block_names_[first->first_block];
    std::vector<std::string> moved;
    for (const int b : first->moved_blocks) moved.push_back(block_names_[b]);
    json["moved_blocks"] = moved;
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

}  // namespace ddacontact
