#include "checkpoints.hpp"

#include <ddacontact/scene/resumption.hpp>

namespace dda {

using namespace ddacontact;

Checkpoints::Checkpoints(const Scene& scene, const std::filesystem::path& directory, int every)
    : scene_(scene),
      resumable_part_(resumable_part(scene)),
      path_(directory / checkpoint_file),
      every_(every) {}

void Checkpoints::write_if_due(const Stepper& stepper, ResultDirectory& results) {
  if (every_ > 0 && stepper.counts().steps % every_ == 0) write(stepper, results);
}

void Checkpoints::write(const Stepper& stepper, ResultDirectory& results) {
  const ResultMarks marks = results.marks();
  write_checkpoint(
      path_, {resumable_part_, steps_of_stages_before(scene_, stepper.stage()), marks, stepper.run_record()});
}

}  // namespace dda
