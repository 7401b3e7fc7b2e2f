/// \file Measurements as a table in a file: the program that measures writes it, the one that draws reads it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace work_precision {

/// One discretization of one problem, solved in one way; medians of seconds.
struct Measurement {
  std::string problem, method, solver;
  int n_cells = 0, n_unknowns = 0;
  double l2 = 0, energy = 0;  ///< relative errors
  double mesh = 0, pattern = 0, assembly = 0, factorization = 0, solve = 0;
  double total() const { return pattern + assembly + factorization + solve; }
};

/// Comma-separated, with a line of names. Throws polyfem::Error when it cannot.
void write_table(const std::filesystem::path& path, const std::vector<Measurement>& measurements);
/// Throws polyfem::Error for a file that is missing or that `write_table` has not written.
std::vector<Measurement> read_table(const std::filesystem::path& path);

}  // namespace work_precision
