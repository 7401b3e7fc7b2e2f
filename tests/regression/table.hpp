/// \file The regression table: what is expected of the numbers of a scene.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace regression {

/// What a row expects.
enum class Expectation {
  bound,  ///< a modulus of `value` at most
  known   ///< what a formula or a law says, independent of the program
};

/// One number of a scene, with what is expected of it.
struct Row {
  std::string scene, quantity;
  Expectation expectation = Expectation::known;
  double value = 0;
  double tolerance = 0;  ///< absolute; of bounds 0
  std::string unit;
  std::string source;  ///< of what is known: the formula

  /// How far `seen` is off, 1: as far as it may be.
  double deviation(double seen) const;
};

/// Throws Error for columns or words that are missing or unknown.
std::vector<Row> read_table(const std::filesystem::path& file);

}  // namespace regression
