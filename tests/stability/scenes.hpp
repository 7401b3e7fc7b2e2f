/// \file Scenes of every kind, to be stated otherwise and run again.
#pragma once

#include <tests/support/scene_changes.hpp>

#include <string>
#include <vector>

namespace stability {

using namespace ddacontact;

struct NamedScene {
  std::string name;
  Scene scene;
  bool takes_long = false;  ///< more than a tenth of a second
};

/// The paper's examples, as they are and with the default mechanics; one drop of each kind of
/// support/random_scenes.hpp and support/any_drops.hpp; hard ones of support/made_scenes.hpp; beams, frames
/// and columns of all models with supports, loads, monitors, damping, bonds, materials and stages; each
/// scheme.
std::vector<NamedScene> scenes_of_every_kind();

/// A run to its end, or to where it stopped.
struct Run {
  StepCounts counts;
  std::string stopped_by;  ///< empty: it did not
  double time = 0;
  std::vector<Points> displacements;  ///< of the scene's vertices, block by block, m
  VectorXd velocity, rotation;
  Tensors stress;
  Points reactions;
  bool finite = true;
};
/// Steps of the scene, at most `most_steps`.
Run run_to_end(const Scene& scene, int most_steps);

/// The square root of the smallest free block's area, m.
double smallest_size(const Scene& scene);
/// The largest distance between two vertices' displacements. `by` turns those of the first run.
double distance(const Run& one, const Run& other, const Mat2& by = Mat2::Identity());
double largest_displacement(const Run& run);
/// Steps, substeps, rejected ones and iterations.
bool same_counts(const Run& one, const Run& other);

/// The scene written to a file and read again: what reads scenes has its say too. Throws Error with the first
/// problem where it is refused.
Scene as_read(const Scene& scene);

}  // namespace stability
