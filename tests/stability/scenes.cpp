#include "scenes.hpp"

#include <tests/support/any_drops.hpp>
#include <tests/support/made_scenes.hpp>
#include <tests/support/random_scenes.hpp>

#include <ddacontact/scene/reader.hpp>
#include <ddacontact/scene/writer.hpp>
#include <polyfem/geometry/area_moments.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace stability {

namespace {

Scene read(const SceneReading& reading) {
  if (!reading.scene) throw Error(reading.problems.front().text());
  return *reading.scene;
}

Scene example(const std::string& name, const std::vector<std::string>& settings = {}) {
  return read(read_scene(POLYDDA_EXAMPLES "/" + name + ".toml", settings));
}

const std::vector<std::string> default_mechanics{"analysis.preset=default",
                                                 "analysis.max_displacement_ratio=0.1"};

/// A frame of beams and plates of every model, held, moved and loaded in every way.
constexpr const char* frame = R"(format = 1
[analysis]
steps = 40
time_step = 0.01
damping = { mass = 0.5, stiffness = 1e-4 }
[[material]]
name = "rock"
density = 2500
young = "2 GPa"
poisson = 0.25
[[material]]
name = "soil"
unit_weight = "18 kN/m3"
young = "50 MPa"
poisson = 0.4
[[joint]]
name = "rough"
friction_angle = 30
restitution = 0.3
dashpot = 0.1
[[joint]]
name = "glued"
between = ["rock", "soil"]
friction_angle = 20
cohesion = "20 kPa"
tensile_strength = "5 kPa"
[[block]]
name = "ground"
material = "soil"
model = "mesh"
mesh = { kind = "quads", cells = 24 }
vertices = [[-4, -1], [4, -1], [4, 0], [-4, 0]]
[[block]]
name = "left"
material = "rock"
model = "wachspress"
vertices = [[-3, 0], [-2, 0], [-2, 1.5], [-3, 1.5]]
[[block]]
name = "right"
material = "rock"
model = "affine"
vertices = [[2, 0], [3, 0], [3, 1.5], [2, 1.5]]
[[block]]
name = "lintel"
material = "rock"
model = "mesh"
mesh = { kind = "quads", cells = 32 }
vertices = [[-3, 1.5], [3, 1.5], [3, 2], [-3, 2]]
[[block]]
name = "ell"
material = "rock"
model = "mean_value"
vertices = [[-1, 2], [0.5, 2], [0.5, 2.5], [-0.5, 2.5], [-0.5, 3.25], [-1, 3.25]]
stress = [0, "-10 kPa", 0]
[[block]]
name = "ball"
material = "soil"
vertices = [[1.5, 2.25], [2, 2.125], [2.5, 2.5], [2.25, 3], [1.625, 2.875]]
velocity = [0.5, -2]
angular_velocity = 2
[[support]]
block = "ground"
vertices = [0, 1]
axes = "xy"
history = [[0, 0, 0], [0.1, 0, 0], [0.25, 0.01, 0.002], [0.4, 0.01, 0]]
[[load]]
type = "point"
block = "lintel"
at = [0.25, 2]
history = [[0, 0, 0], [0.1, 0, 0], [0.2, 2e3, -8e3]]
[[load]]
type = "pressure"
block = "left"
edge = 3
value = "3 kPa"
[[load]]
type = "body"
block = "ell"
force = [1e3, 0]
[[monitor]]
name = "middle"
block = "lintel"
at = [0, 1.75]
[[monitor]]
name = "corner"
block = "ball"
vertex = 2
)";

/// Cantilevers of the models that bend and of those that do not, and a column, under loads at rest.
constexpr const char* beams = R"(format = 1
[analysis]
mode = "static"
steps = 10
time_step = 0.1
[[material]]
name = "rock"
density = 2500
young = "1 GPa"
poisson = 0.3
[[joint]]
name = "rough"
friction_angle = 35
[[block]]
material = "rock"
name = "beam"
vertices = [[0, 0], [4, 0], [4, 0.5], [0, 0.5]]
fixed = [0, 3]
[[block]]
material = "rock"
name = "stiff"
vertices = [[0, 2], [0.75, 2], [0.75, 2.5], [0, 2.5]]
fixed = [0, 3]
model = "wachspress"
[[block]]
material = "rock"
name = "foot"
vertices = [[8, 0], [9, 0], [9, 0.5], [8, 0.5]]
fixed = true
[[block]]
material = "rock"
name = "column"
vertices = [[8, 0.5], [8.5, 0.5], [8.5, 3.5], [8, 3.5]]
[[support]]
block = "stiff"
vertices = [1]
axes = "xy"
displacement = [0, -0.001]
[[load]]
type = "point"
block = "beam"
at = [4, 0.25]
force = [0, -2e3]
[[load]]
type = "pressure"
block = "column"
edge = 2
value = "10 kPa"
)";

Scene text_scene(const char* text, const std::vector<std::string>& settings = {}) {
  return read(read_scene_text(text, "scene", settings));
}

}  // namespace

std::vector<NamedScene> scenes_of_every_kind() {
  std::vector<NamedScene> scenes;
  for (const std::string name : {"sliding_0", "sliding_15", "sliding_30", "sliding_40", "arch_frictionless",
                                 "arch_friction30", "voronoi_gravity", "voronoi_push"}) {
    scenes.push_back({name, example("paper/" + name)});
    scenes.push_back({name + ", default mechanics", example("paper/" + name, default_mechanics),
                      name.starts_with("voronoi")});
  }
  scenes.push_back({"excavation", example("excavation")});
  for (int k = 0; k < support::n_drop_kinds; ++k) {
    const auto seed = static_cast<std::uint64_t>(k + 2 * support::n_drop_kinds);
    scenes.push_back({"drop of " + name_of(support::drop_kind(seed)), support::random_drop(seed)});
  }
  for (int k = 0; k < support::n_grounds; ++k) {
    const auto seed = static_cast<std::uint64_t>(k + 8);
    scenes.push_back({"any shapes on " + name_of(support::ground_of(seed)), support::any_drop(seed)});
  }
  for (const auto& [name, scene] : support::made_scenes())
    if (name != "slope_stays" && name != "slope_slides") scenes.push_back({name, scene});
  scenes.push_back({"frame", text_scene(frame)});
  for (const char* scheme : {"midpoint", "newmark", "backward_euler", "dda"})
    scenes.push_back(
        {std::string("frame, ") + scheme, text_scene(frame, {std::string("analysis.scheme=") + scheme})});
  scenes.push_back({"beams", text_scene(beams)});
  for (NamedScene& named : scenes)
    if (named.scene.stages.empty()) named.scene.analysis.steps = std::min(named.scene.analysis.steps, 25);
  return scenes;
}

Run run_to_end(const Scene& scene, int most_steps) {
  const BuiltScene built = build(scene);
  Stepper& stepper = *built.stepper;
  Run run;
  for (int k = 0; k < std::min(scene.n_steps(), most_steps); ++k)
    if (!stepper.step()) {
      run.stopped_by = stepper.stop_reason();
      break;
    }
  run.counts = stepper.counts();
  const BlockState& state = stepper.state();
  run.time = state.time;
  run.displacements = support::vertex_displacements(built);
  run.velocity = state.velocity;
  run.rotation = state.rotation;
  run.stress = state.stress;
  run.reactions = stepper.reactions();
  run.finite = state.position.allFinite() && state.velocity.allFinite() && state.stress.allFinite() &&
               run.reactions.allFinite();
  return run;
}

double smallest_size(const Scene& scene) {
  double smallest = 0;
  for (const BlockDescription& block : scene.blocks) {
    const double size = std::sqrt(std::abs(polyfem::signed_area(block.vertices)));
    if (!block.fixed && (smallest == 0 || size < smallest)) smallest = size;
  }
  return smallest;
}

double distance(const Run& one, const Run& other, const Mat2& by) {
  double largest = 0;
  for (std::size_t b = 0; b < one.displacements.size(); ++b)
    largest =
        std::max(largest, (other.displacements[b] - by * one.displacements[b]).colwise().norm().maxCoeff());
  return largest;
}

double largest_displacement(const Run& run) {
  double largest = 0;
  for (const Points& of : run.displacements) largest = std::max(largest, of.colwise().norm().maxCoeff());
  return largest;
}

bool same_counts(const Run& one, const Run& other) {
  const StepCounts &a = one.counts, &b = other.counts;
  return a.steps == b.steps && a.substeps == b.substeps && a.rejected == b.rejected &&
         a.contact_iterations == b.contact_iterations && a.contacts_max == b.contacts_max &&
         a.interior_point_solves == b.interior_point_solves && a.augmentations == b.augmentations;
}

Scene as_read(const Scene& scene) {
  std::ostringstream text;
  write_scene(text, scene);
  return read(read_scene_text(text.str(), "scene"));
}

}  // namespace stability
