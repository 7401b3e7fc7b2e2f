/// \file What was measured of some steps of a scene, as a row of a table in a file.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace step_performance {

/// Of one scene in one size, stepped in one way. Seconds are medians over the steps measured, counts means
/// over them. One thread's time is the processor's, so that others may use the machine too, several threads'
/// is by the clock. What is not known is 0.
struct Measurement {
  std::string scene;            ///< see performance::scene_kinds, or the directory of a result
  std::string start;            ///< "sudden": unstressed under sudden gravity | "settled": in equilibrium
  std::string method;           ///< "default" | "classic" (performance::make_classic), "explicit" (that
                                ///< scheme), "coarse" (contacts to 1e-3)
  std::string without;          ///< skips that were switched off, with spaces between
  std::string status = "done";  ///< or why there is no more
  double time_step = 0;         ///< s
  double threads = 1;
  double size = 0;  ///< that was requested of the scene
  double blocks = 0, unknowns = 0, steps = 0;

  double setup = 0;  ///< s, from the scene to blocks ready to step

  double total = 0;  ///< s a step
  double detection = 0, assembly = 0;
  double analysis = 0, factorization = 0, solution = 0;  ///< of the linear solver
  double solver = 0;                                     ///< what else the solver does
  double update = 0;
  double rest = 0;    ///< of the total
  double output = 0;  ///< beside the total; of runs of the program
  double mean = 0;    ///< of the total: the mean instead of the median

  double substeps = 0, rejected = 0, iterations = 0, linear_solves = 0, factorizations = 0, analyses = 0;
  double contacts = 0;       ///< closed at the end
  double largest_speed = 0;  ///< of an unknown at the end, m/s

  // Memory, MB: of the process at most; of its heap what building takes, and what steps add to that; and of
  // both together what the factor takes.
  double peak = 0, heap_blocks = 0, heap_steps = 0, factor_memory = 0;

  // CHOLMOD alone on the matrix of the last step, s and MB: vertices ordered by AMD and by METIS.
  double amd_analysis = 0, amd_factorization = 0, amd_solution = 0, amd_factor = 0;
  double metis_analysis = 0, metis_factorization = 0, metis_solution = 0, metis_factor = 0;
  // Of the same matrix the fronts of polydda.
  double own_analysis = 0, own_factorization = 0, own_solution = 0;

  /// Seconds of the linear solver, and of everything else.
  double linear() const { return analysis + factorization + solution; }
  double outside() const { return total - linear(); }
  /// Seconds of a factorization and a solution by CHOLMOD in the better order; 0 when not known.
  double cholmod() const;
};

/// A column: its name and where its value is.
using Column = std::pair<const char*, std::variant<std::string Measurement::*, double Measurement::*>>;
const std::vector<Column>& columns();

/// A line without its end; the names of the columns are the first line of a file.
std::string header_line();
std::string line_of(const Measurement& measurement);
/// Throws polyfem::Error for a line that does not have these columns.
Measurement measurement_of(const std::string& line);

/// Throws polyfem::Error when it cannot be written, read, or is no such table.
void write_table(const std::filesystem::path& path, const std::vector<Measurement>& table);
std::vector<Measurement> read_table(const std::filesystem::path& path);

}  // namespace step_performance
