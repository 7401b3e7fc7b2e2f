/// \file The regression table: what is expected of the numbers of a scene.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace regression {

/// What a row expects.
enum class Expectation {
  computed,  ///< what was computed when the table was written
  bound,     ///< a modulus of `value` at most
  known      ///< what a formula or a law says, independent of the program
};

/// One number of a scene, with what is expected of it.
struct Row {
  std::string scene, quantity;
  Expectation expectation = Expectation::computed;
  double value = 0;
  double tolerance = 0;  ///< absolute; of bounds 0
  std::string unit;
  std::string source;  ///< of what is known: the formula

  /// How far `seen` is off, 1: as far as it may be.
  double deviation(double seen) const;
};

/// Throws Error for what write_table has not made.
std::vector<Row> read_table(const std::filesystem::path& file);
void write_table(const std::filesystem::path& file, const std::vector<Row>& rows);

std::string name_of(Expectation expectation);

}  // namespace regression
