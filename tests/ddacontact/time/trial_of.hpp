/// \file The trial of a step, on its own: what a stepper makes of a scene, before its first step or after
/// some.
#pragma once

#include <ddacontact/time/trial_step.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

namespace support {

/// A trial of the step that begins where a stepper stands.
struct TrialOf {
  BuiltScene built;
  BlockSystem& blocks;
  BlockState state;
  std::vector<ContactRecord> contacts;
  AnalysisOptions analysis;
  ContactProperties properties;
  StepCounts counts;
  Participants participants{&blocks, &state};
  TrialStep trial;

  explicit TrialOf(const Scene& scene, int steps_before = 0)
      : built(build(scene)),
        blocks(blocks_of(built)),
        state((run(*built.stepper, steps_before), built.stepper->state())),
        contacts(built.stepper->contacts()),
        analysis(built.stepper->stages()[0].analysis),
        properties(built.stepper->contact_properties()),
        trial(participants, contacts, analysis, properties, counts) {
    trial.make_system();
  }
  TrialOf(const TrialOf&) = delete;
  TrialOf& operator=(const TrialOf&) = delete;

  double dt() const { return analysis.time_step; }
  /// Contacts that go on with those of the stepper.
  void detect(double margin = 0.05) {
    trial.detect(dt(), std::vector<double>(static_cast<std::size_t>(blocks.n_blocks()), margin), false);
  }
  TrialSolution solve(double margin = 0.05) {
    detect(margin);
    return trial.solve(dt());
  }
  /// The mean over the vertices of a block.
  Vec2 mean_motion(const VectorXd& d, int b) const {
    Vec2 sum = Vec2::Zero();
    for (int k = 0; k < blocks.block(b).n_vertices(); ++k) sum += blocks.block(b).vertex_map(k)(d);
    return sum / blocks.block(b).n_vertices();
  }
  Vec2 velocity(const BlockState& of, int b) const {
    return rigid_velocity(blocks.block(b), of, of.going_on()).linear;
  }
  double normal_force() {
    double sum = 0;
    for (const Contact& contact : trial.contacts()) sum += contact.normal;
    return sum;
  }
};

}  // namespace support
