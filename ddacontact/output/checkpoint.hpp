/// \file A run put aside: a file to go on from as if the run had never stopped.
#pragma once

#include <ddacontact/output/result_marks.hpp>
#include <ddacontact/time/run_record.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace ddacontact {

/// Everything that goes into the file.
struct Checkpoint {
  std::string scene;             ///< what of the scene must be the same, as text
  std::vector<int> stage_steps;  ///< of the stages that are over and of the present one
  std::string made_by;           ///< program, BLAS and compiler: others may make other last digits
  ResultMarks marks;             ///< where the histories beside it stand
  RunRecord record;
};

/// Writes the file whole or not at all: an older one stays until the new one is on the disk. Throws
/// OutputError.
void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);

/// Throws OutputError, which names the file: it is missing, it is no checkpoint, of another version of the
/// format or another kind of machine, or damaged.
Checkpoint read_checkpoint(const std::filesystem::path& path);

}  // namespace ddacontact
