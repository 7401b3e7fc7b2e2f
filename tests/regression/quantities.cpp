#include "quantities.hpp"

#include <ddacontact/block/rigid_velocity.hpp>
#include <ddacontact/output/block_summary.hpp>
#include <ddacontact/scene/builder.hpp>
#include <ddacontact/scene/reader.hpp>
#include <tests/support/pair_size.hpp>

#include <algorithm>
#include <cmath>

namespace regression {

namespace {

using namespace ddacontact;

constexpr std::pair<const char*, double Energy::*> energies[] = {{"kinetic", &Energy::kinetic},
                                                                 {"elastic", &Energy::elastic},
                                                                 {"gravity", &Energy::gravity},
                                                                 {"friction", &Energy::friction_dissipated},
                                                                 {"damping", &Energy::damping_dissipated},
                                                                 {"numerical", &Energy::numerical_dissipated},
                                                                 {"external", &Energy::external}};

Scene scene_of(const ListedScene& listed) {
  SceneReading reading = read_scene(listed.file.string(), listed.settings);
  for (const Problem& problem : reading.problems)
    if (problem.severity == Problem::Severity::error) throw Error(problem.text());
  if (!reading.scene) throw Error("cannot read \"" + listed.file.string() + "\"");
  return std::move(*reading.scene);
}

bool is_free(const Stepper& stepper, int b) {
  return stepper.blocks().is_present(b) && stepper.blocks().is_movable(b);
}

/// Calls `visit` with every block that is there and can move.
template <class Visit>
void for_free_blocks(const Stepper& stepper, Visit&& visit) {
  for (int b = 0; b < stepper.blocks().n_blocks(); ++b)
    if (is_free(stepper, b)) visit(b);
}

/// The force of a contact on the block of its vertex, N per m.
Vec2 force_of(const ContactRecord& contact, const Stepper& stepper) {
  const Points outline =
      stepper.blocks().outline_from(stepper.state(), contact.pair.edge_block, contact.pair.edge_block);
  const Vec2 along =
      (outline.col((contact.pair.edge + 1) % outline.cols()) - outline.col(contact.pair.edge)).normalized();
  return contact.normal * Vec2(along.y(), -along.x()) + contact.shear * along;
}

/// What block `on` is pushed with by block `by`.
Vec2 force_between(const Stepper& stepper, int on, int by) {
  Vec2 sum = Vec2::Zero();
  for (const ContactRecord& contact : stepper.contacts()) {
    if (contact.pair.vertex_block == on && contact.pair.edge_block == by) sum += force_of(contact, stepper);
    if (contact.pair.vertex_block == by && contact.pair.edge_block == on) sum -= force_of(contact, stepper);
  }
  return sum;
}

int block_called(const Labels& labels, const std::string& name) {
  const auto found = std::find(labels.block_names.begin(), labels.block_names.end(), name);
  if (found == labels.block_names.end()) throw Error("no block is called \"" + name + "\"");
  return static_cast<int>(found - labels.block_names.begin());
}

double largest_displacement(const Stepper& stepper) {
  const Points displacements = stepper.blocks().displacements(stepper.state());
  double size = 0;
  for_free_blocks(stepper, [&](int b) {
    const Range& places = stepper.blocks().block(b).points();
    size = std::max(size, displacements.middleCols(places.first, places.count).colwise().norm().maxCoeff());
  });
  return size;
}

/// The deepest penetration of the closed contacts, of the block size.
double penetration(const Stepper& stepper) {
  double deepest = 0;
  for (const ContactRecord& contact : stepper.contacts())
    if (contact.closed())
      deepest = std::max(deepest, -contact.end_gap / support::pair_size(stepper.blocks(), contact.pair));
  return deepest;
}

void add(const std::string& quantity, const Vec2& value, Measured& measured) {
  measured["x " + quantity] = value.x();
  measured["y " + quantity] = value.y();
}

void add_momenta(const Stepper& stepper, Measured& measured) {
  Vec2 linear = Vec2::Zero();
  double angular = 0;
  for_free_blocks(stepper, [&](int b) {
    const Block& block = stepper.blocks().block(b);
    const RigidVelocity velocity = rigid_velocity(block, stepper.state(), stepper.state().velocity);
    const Vec2 momentum = block.mass_total() * velocity.linear;
    const VectorXd turning = block.rotation(stepper.state());
    linear += momentum;
    angular += cross(block.centroid(stepper.state()), momentum) +
               velocity.angular * turning.dot(block.mass() * turning);
  });
  add("momentum", linear, measured);
  measured["angular momentum"] = angular;
}

void add_monitor(const MonitorTarget& monitor, const Stepper& stepper, bool moves, Measured& measured) {
  const Motion motion = observe(monitor, stepper);
  add("displacement of " + monitor.name, motion.displacement, measured);
  if (moves) add("velocity of " + monitor.name, motion.velocity, measured);
  const Vec3 stress = mean_stress(stepper.blocks().block(monitor.block()), stepper.state());
  for (int k = 0; k < 3; ++k)
    measured[std::array{"xx", "yy", "xy"}[k] + std::string(" stress at ") + monitor.name] = stress[k];
}

double area_of(const Stepper& stepper) {
  double sum = 0;
  for_free_blocks(stepper, [&](int b) { sum += stepper.blocks().block(b).moments(stepper.state()).area; });
  return sum;
}

}  // namespace

Measured measure(const ListedScene& listed) {
  const Scene scene = scene_of(listed);
  const BuiltScene built = build(scene);
  Stepper& stepper = *built.stepper;
  double deepest = penetration(stepper);
  for (int step = 0; step < scene.n_steps(); ++step) {
    if (!stepper.step())
      throw Error("the run stops in step " + std::to_string(step + 1) + ": " + stepper.stop_reason());
    deepest = std::max(deepest, penetration(stepper));
  }

  const bool moves =
      (scene.stages.empty() ? scene.analysis : scene.stages.back().analysis).mode == Mode::dynamic;
  Measured measured;
  add("reactions", stepper.reactions().rowwise().sum(), measured);
  for (const auto& [on, by] : listed.pairs)
    add("force on " + on + " by " + by,
        force_between(stepper, block_called(built.labels, on), block_called(built.labels, by)), measured);
  for (const auto& [name, entry] : energies)
    measured[name + std::string(" energy")] = stepper.energy().now.*entry;
  if (moves) add_momenta(stepper, measured);
  measured["largest displacement"] = largest_displacement(stepper);
  measured["area"] = area_of(stepper);
  for (const MonitorTarget& monitor : built.monitor_targets)
    if (stepper.blocks().is_present(monitor.block())) add_monitor(monitor, stepper, moves, measured);
  measured["closed contacts"] = static_cast<double>(stepper.counts().contacts);
  measured["penetration"] = deepest;
  measured["balance error"] = stepper.energy().balance_error();
  measured["unconverged substeps"] = static_cast<double>(stepper.counts().unconverged);
  return measured;
}

}  // namespace regression
