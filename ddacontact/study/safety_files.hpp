/// \file What a search for the factor of safety leaves: safety.csv, safety.json, safety.svg and
/// safety_moved.svg.
#pragma once

#include <ddacontact/output/csv_file.hpp>
#include <ddacontact/scene/scene.hpp>
#include <ddacontact/study/variant_trials.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace ddacontact {

/// "rests", "moves" or "stopped".
std::string word_of(Verdict verdict);

/// What happens to cohesion and tensile strength of these joints, indices, where they slip in the last stage:
/// "ductile" (they last), "brittle" (they are lost), "mixed" or, without any of either, "none".
std::string bonds_of(const Scene& scene, const std::vector<int>& joints);

/// Blocks that move, and their part of all that may.
struct MovedPart {
  int blocks = 0, of_blocks = 0;
  double area_share = 0;  ///< 0 .. 1
};

/// Of a trial. Blocks that are fixed, or taken out before the end, do not count.
MovedPart moved_part(const Scene& scene, const StrengthTrial& trial);

/// Writes a row of safety.csv with every trial, and the rest at the end.
class SafetyFiles {
 public:
  /// Makes the directory. Throws OutputError, as all others.
  /// \param[in] scene   with ductile bonds marked, as StrengthReduction does
  /// \param[in] joints  indices of those that are reduced
  SafetyFiles(std::filesystem::path directory, Scene scene, std::vector<int> joints);

  void add(const StrengthTrial& trial);
  /// Without a trial `unsettled` is why there is none.
  /// \param[in] unsettled     see StrengthReduction
  /// \param[in] wall_seconds  that settling and all trials took
  void finish(const FactorBracket& bracket, const VariantTrials& variants, double tolerance,
              const std::string& unsettled, double wall_seconds);
  /// The trial that moved at the lowest factor; null: none moved.
  const StrengthTrial* first_to_move() const;
  const StrengthTrial& last() const { return trials_.back(); }

 private:
  void write_json(const FactorBracket& bracket, const VariantTrials& variants, double tolerance,
                  const std::string& unsettled, double wall_seconds) const;
  void draw_curve() const;
  void draw_moved(const StrengthTrial& trial) const;
  std::vector<std::string> names_of_joints() const;

  std::filesystem::path directory_;
  Scene scene_;
  std::vector<int> joints_;
  CsvFile csv_;
  std::vector<StrengthTrial> trials_;
};

}  // namespace ddacontact
