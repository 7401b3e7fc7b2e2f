/// \file The checkpoint of a run: written in time, read to go on.
#pragma once

#include <ddacontact/output/checkpoint.hpp>
#include <ddacontact/output/result_directory.hpp>
#include <ddacontact/scene/scene.hpp>
#include <ddacontact/time/stepper.hpp>

#include <filesystem>
#include <string>

namespace dda {

constexpr char checkpoint_file[] = "checkpoint.bin";

/// Writes the checkpoints of a run, each in place of the one before.
class Checkpoints {
 public:
  /// \param[in] every  steps between them; 0: only when requested
  /// \param[in] made_by  program, BLAS and compiler
  Checkpoints(const ddacontact::Scene& scene, const std::filesystem::path& directory, int every,
              std::string made_by);

  /// Every so many steps.
  void write_if_due(const ddacontact::Stepper& stepper, ddacontact::ResultDirectory& results);
  /// Unless it has been written already. Throws OutputError; the last one is as it was then.
  void write(const ddacontact::Stepper& stepper, ddacontact::ResultDirectory& results);

 private:
  const ddacontact::Scene& scene_;
  std::string resumable_part_, made_by_;
  std::filesystem::path path_;
  int every_;
  long written_substeps_ = -1;  ///< made when the last one was written
};

}  // namespace dda
