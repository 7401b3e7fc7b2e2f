/// \file What a search for the factor of safety leaves: safety.csv, safety.json and safety.svg.
#pragma once

#include <ddacontact/output/csv_file.hpp>
#include <ddacontact/study/strength_trial.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace ddacontact {

/// "rests", "moves" or "stopped".
std::string word_of(Verdict verdict);

/// Writes a row of safety.csv with every trial, and the rest at the end.
class SafetyFiles {
 public:
  /// Makes the directory. Throws OutputError, as all others.
  /// \param[in] block_names  as results call them
  SafetyFiles(std::filesystem::path directory, std::vector<std::string> block_names);

  void add(const StrengthTrial& trial);
  /// \param[in] unsettled  see StrengthReduction
  void finish(const FactorBracket& bracket, double tolerance, const std::vector<std::string>& joints,
              const std::string& unsettled);
  /// The trial that moved at the lowest factor; null: none moved.
  const StrengthTrial* first_to_move() const;
  const std::string& name_of(int block) const { return block_names_[block]; }

 private:
  void write_json(const FactorBracket& bracket, double tolerance, const std::vector<std::string>& joints,
                  const std::string& unsettled) const;
  void draw_curve() const;

  std::filesystem::path directory_;
  std::vector<std::string> block_names_;
  CsvFile csv_;
  std::vector<StrengthTrial> trials_;
};

}  // namespace ddacontact
