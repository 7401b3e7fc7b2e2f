#include "checkpoints.hpp"

#include <ddacontact/scene/resumption.hpp>

namespace dda {

using namespace ddacontact;

Checkpoints::Checkpoints(const Scene& scene, const std::filesystem::path& directory, int every,
                         std::string made_by)
    : scene_(scene),
      resumable_part_(resumable_part(scene)),
      made_by_(std::move(made_by)),
      path_(directory / checkpoint_file),
      every_(every) {}

void Checkpoints::write_if_due(const Stepper& stepper, ResultDirectory& results) {
  if (every_ > 0 && stepper.counts().steps % every_ == 0) write(stepper, results);
}

void Checkpoints::write(const Stepper& stepper, ResultDirectory& results) {
  if (written_substeps_ == stepper.counts().substeps) return;
  const ResultMarks marks = results.marks();
  write_checkpoint(path_, {resumable_part_, steps_of_stages_to(scene_, stepper.stage()), made_by_, marks,
                           stepper.run_record()});
  written_substeps_ = stepper.counts().substeps;
}

}  // namespace dda
