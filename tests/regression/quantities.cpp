#include "quantities.hpp"

#include <ddacontact/block/rigid_velocity.hpp>
#include <ddacontact/output/block_summary.hpp>
#include <ddacontact/scene/builder.hpp>
#include <ddacontact/scene/reader.hpp>
#include <tests/support/pair_size.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

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

/// What the staged method keeps the energy balance to, of the largest energy exchanged.
constexpr double balance_bound = 1e-6;
/// How far beyond its tolerance a penetration may be found: round-off.
constexpr double penetration_margin = 1.01;

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

double largest(const TimeFunction& force) {
  double size = force.value.norm();
  for (const Vec3& entry : force.history) size = std::max(size, entry.tail<2>().norm());
  return size;
}

double largest_load(const Scene& scene, const Stepper& stepper) {
  double size = 0;
  for (const Load& load : scene.loads) {
    const BlockDescription& block = scene.blocks[load.block];
    const Index n = block.vertices.cols();
    if (load.kind == Load::Kind::point) size = std::max(size, largest(load.force));
    if (load.kind == Load::Kind::body)
      size = std::max(size, largest(load.force) * stepper.blocks().block(load.block).reference_area());
    if (load.kind == Load::Kind::pressure) {
      const Vec2 edge = block.vertices.col((load.edge + 1) % n) - block.vertices.col(load.edge);
      size = std::max(size, largest(load.force) * edge.norm());
    }
  }
  return size;
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

/// What is seen of a run on its way.
struct Extremes {
  double energy = 0;        ///< largest, J per m
  double force = 0;         ///< largest of a support or a contact, N per m
  double displacement = 0;  ///< largest, m
  double penetration = 0;   ///< deepest, of the block size

  void see(const Stepper& stepper) {
    for (const auto& [name, entry] : energies)
      energy = std::max(energy, std::abs(stepper.energy().now.*entry));
    force = std::max(force, stepper.reactions().cwiseAbs().maxCoeff());
    displacement = std::max(displacement, largest_displacement(stepper));
    for (const ContactRecord& contact : stepper.contacts()) {
      force = std::max(force, contact.normal);
      if (contact.closed())
        penetration =
            std::max(penetration, -contact.end_gap / support::pair_size(stepper.blocks(), contact.pair));
    }
  }
};

/// Appends rows of one scene.
class Rows {
 public:
  Rows(std::string scene, double relative) : scene_(std::move(scene)), relative_(relative) {}

  void add(std::string quantity, double value, double scale, std::string unit) {
    measured.push_back(
        {{scene_, std::move(quantity), Expectation::computed, value, relative_ * scale, std::move(unit), ""},
         value});
  }
  void add(const std::string& quantity, const Vec2& value, double scale, const std::string& unit) {
    add("x " + quantity, value.x(), scale, unit);
    add("y " + quantity, value.y(), scale, unit);
  }
  void exact(std::string quantity, double value) { add(std::move(quantity), value, 0, "1"); }
  void bound(std::string quantity, double seen, double bound) {
    measured.push_back({{scene_, std::move(quantity), Expectation::bound, bound, 0, "1", ""}, seen});
  }

  std::vector<Measured> measured;

 private:
  std::string scene_;
  double relative_;
};

/// Scales that tolerances are relative to.
struct Scales {
  double force = 0, length = 0, displacement = 0, energy = 0, mass = 0, area = 0, speed = 0, stress = 0;

  Scales(const Scene& scene, const Stepper& stepper, const Extremes& extremes) : energy(extremes.energy) {
    length = std::numeric_limits<double>::infinity();
    double initial_stress = 0;
    for_free_blocks(stepper, [&](int b) {
      const Block& block = stepper.blocks().block(b);
      length = std::min(length, block.size());
      mass += block.mass_total();
      area += block.reference_area();
      initial_stress = std::max(initial_stress, scene.blocks[b].stress.cwiseAbs().maxCoeff());
    });
    force = std::max(mass * scene.analysis.gravity.norm(), largest_load(scene, stepper));
    if (force == 0) force = std::max(extremes.force, energy / length);
    displacement = stepper.counts().contacts_max == 0 ? std::min(length, extremes.displacement) : length;
    speed = std::sqrt(2 * energy / mass);
    stress = std::max(force / length, initial_stress);
  }
};

void add_momenta(const Stepper& stepper, const Scales& scale, Rows& rows) {
  Vec2 linear = Vec2::Zero();
  double angular = 0;
  for_free_blocks(stepper, [&](int b) {
    const Block& block = stepper.blocks().block(b);
    const RigidVelocity velocity = rigid_velocity(block, stepper.state().velocity);
    const Vec2 momentum = block.mass_total() * velocity.linear;
    const VectorXd& turning = block.rotation();
    linear += momentum;
    angular += cross(block.centroid(), momentum) + velocity.angular * turning.dot(block.mass() * turning);
  });
  rows.add("momentum", linear, scale.mass * scale.speed, "kg m/s");
  rows.add("angular momentum", angular, scale.mass * scale.speed * scale.length, "kg m2/s");
}

void add_monitor(const MonitorTarget& monitor, const Stepper& stepper, bool moves, const Scales& scale,
                 Rows& rows) {
  const Motion motion = observe(monitor, stepper);
  rows.add("displacement of " + monitor.name, motion.displacement, scale.displacement, "m");
  if (moves) rows.add("velocity of " + monitor.name, motion.velocity, scale.speed, "m/s");
  const Vec3 stress = mean_stress(stepper.blocks().block(monitor.block()), stepper.state());
  for (int k = 0; k < 3; ++k)
    rows.add(std::array{"xx", "yy", "xy"}[k] + std::string(" stress at ") + monitor.name, stress[k],
             scale.stress, "Pa");
}

double area_of(const Stepper& stepper) {
  double sum = 0;
  for_free_blocks(stepper, [&](int b) { sum += stepper.blocks().block(b).moments().area; });
  return sum;
}

}  // namespace

std::vector<Measured> measure(const ListedScene& listed) {
  const Scene scene = scene_of(listed);
  const BuiltScene built = build(scene);
  Stepper& stepper = *built.stepper;
  Extremes extremes;
  extremes.see(stepper);
  for (int step = 0; step < scene.n_steps(); ++step) {
    if (!stepper.step())
      throw Error("the run stops in step " + std::to_string(step + 1) + ": " + stepper.stop_reason());
    extremes.see(stepper);
  }

  const Scales scale(scene, stepper, extremes);
  const bool moves =
      (scene.stages.empty() ? scene.analysis : scene.stages.back().analysis).mode == Mode::dynamic;
  const bool staged = scene.contact.method == ContactMethod::staged;
  Rows rows(listed.name, relative_tolerance(listed.scene_class));

  rows.add("reactions", stepper.reactions().rowwise().sum(), scale.force, "N/m");
  for (const auto& [on, by] : listed.pairs)
    rows.add("force on " + on + " by " + by,
             force_between(stepper, block_called(built.labels, on), block_called(built.labels, by)),
             scale.force, "N/m");
  for (const auto& [name, entry] : energies)
    rows.add(name + std::string(" energy"), stepper.energy().now.*entry, scale.energy, "J/m");
  if (moves) add_momenta(stepper, scale, rows);
  rows.add("largest displacement", largest_displacement(stepper), scale.displacement, "m");
  rows.add("area", area_of(stepper), scale.area, "m2");
  for (const MonitorTarget& monitor : built.monitor_targets)
    if (stepper.blocks().is_present(monitor.block())) add_monitor(monitor, stepper, moves, scale, rows);
  if (listed.scene_class != SceneClass::chaotic) rows.exact("closed contacts", stepper.counts().contacts);
  if (scene.contact.penetration_tolerance > 0)
    rows.bound("penetration", extremes.penetration, penetration_margin * scene.contact.penetration_tolerance);
  else
    rows.add("penetration", extremes.penetration, 1, "1");
  if (staged) {
    rows.bound("balance error", stepper.energy().balance_error(), balance_bound);
    rows.bound("unconverged substeps", stepper.counts().unconverged, 0);
  } else if (listed.scene_class != SceneClass::chaotic) {
    rows.exact("unconverged substeps", stepper.counts().unconverged);
  }
  return std::move(rows.measured);
}

}  // namespace regression
