#include "forces.hpp"

#include "solver_scenes.hpp"

#include <tests/support/pair_size.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace stability {

namespace {

/// The contacts that are bonded: one whose bond breaks in a step has it to the end of the step.
template <class Contacts>
std::set<VertexEdge> bonded(const Contacts& contacts) {
  std::set<VertexEdge> pairs;
  for (const ContactRecord& contact : contacts)
    if (contact.history.bonded) pairs.insert(contact.pair);
  return pairs;
}

/// \param[in] positions  of all points
VertexEdgePositions place_of(const VertexEdge& pair, const BlockSystem& blocks, const Points& positions) {
  const Range &of_vertex = blocks.block(pair.vertex_block).vertices(),
              &of_edge = blocks.block(pair.edge_block).vertices();
  return {positions.col(of_vertex.first + pair.vertex), positions.col(of_edge.first + pair.edge),
          positions.col(of_edge.first + (pair.edge + 1) % of_edge.count)};
}

}  // namespace

ContactCheck check_contacts(const Scene& scene, int steps) {
  const BuiltScene built = build(scene);
  Stepper& stepper = *built.stepper;
  const Energy& energy = stepper.energy().now;
  ContactCheck check;
  double friction = 0, impacts = 0, largest_energy = 0;
  std::set<VertexEdge> bonds = bonded(stepper.contacts_to_begin_with());
  for (int k = 0; k < steps; ++k) {
    const Points before = stepper.blocks().positions(stepper.state());
    if (!stepper.step()) {
      check.stopped_by = stepper.stop_reason();
      break;
    }
    largest_energy = std::max({largest_energy, energy.kinetic, energy.elastic, std::abs(energy.gravity)});
    double largest = 0;
    for (const ContactRecord& contact : stepper.contacts())
      largest = std::max(largest, std::hypot(contact.normal, contact.shear));
    for (const ContactRecord& contact : stepper.contacts()) {
      if (!contact.closed() || largest == 0) continue;
      ++check.contacts;
      const JointLaw law = stepper.contact_properties().law(contact);
      const bool was_bonded = bonds.contains(contact.pair);
      const double bound = shear_bound(law, contact.normal, was_bonded);
      check.outside = std::max({check.outside, (std::abs(contact.shear) - bound) / largest,
                                (-contact.normal - (was_bonded ? law.tension : 0)) / largest});
      if (!is_slipping(contact.history.state) || contact.shear == 0) continue;
      const double slipped =
          contact.end_slip -
          slip_form(place_of(contact.pair, stepper.blocks(), before), contact.history.lock).constant;
      check.work = std::max(check.work, std::copysign(1, contact.shear) * slipped /
                                            support::pair_size(stepper.blocks(), contact.pair));
      check.work_over_energy = std::max(check.work_over_energy, contact.shear * slipped / largest_energy);
    }
    bonds = bonded(stepper.contacts());
    const double fall = std::max(friction - energy.friction_dissipated, impacts - energy.damping_dissipated);
    if (fall > 0) check.dissipation_falls = std::max(check.dissipation_falls, fall / largest_energy);
    friction = energy.friction_dissipated;
    impacts = energy.damping_dissipated;
  }
  return check;
}

double momentum_drift(const Scene& scene, int steps) {
  const BuiltScene built = build(scene);
  const verification::Momenta start = verification::momenta(*built.stepper);
  double drift = 0;
  for (int k = 0; k < steps; ++k) {
    verification::run(*built.stepper, 1);
    drift = std::max(drift, (verification::momenta(*built.stepper).linear - start.linear).norm());
  }
  return drift / start.sum_of_moduli;
}

Scene flying_assembly(Scheme scheme) {
  Scene scene = rock_scene(1e-3, 1);
  scene.analysis.scheme = scheme;
  scene.analysis.gravity.setZero();
  scene.joints[0].friction_angle = 30;
  scene.joints[0].cohesion = 1e9;
  scene.joints[0].tensile_strength = 1e9;
  for (int k = 0; k < 4; ++k) {
    scene.blocks.push_back(block(rectangle(k % 2, k / 2, 1, 1)));
    // One rigid motion of all: 2 rad/s about (1, 1).
    const Vec2 centre(k % 2 - 0.5, k / 2 - 0.5);
    scene.blocks.back().angular_velocity = 2;
    scene.blocks.back().velocity = Vec2(3, 1) + 2 * Vec2(-centre.y(), centre.x());
  }
  return scene;
}

Scene bouncing_in_a_box(Scheme scheme) {
  Scene scene = rock_scene(1e-2, 1);
  scene.analysis.scheme = scheme;
  scene.analysis.gravity.setZero();
  scene.materials.push_back({"heavy", 25000, 35e9, 0.3});
  scene.joints[0].friction_angle = 20;
  scene.joints[0].restitution = 1;
  Joint bonded{"bonded", 40, 1e12, 1e12, std::array<int, 2>{1, 1}};
  scene.joints.push_back(bonded);
  scene.blocks = {block(rectangle(0, 0, 4, 1)), block(rectangle(3, 1, 1, 3)), block(rectangle(0, 4, 4, 1)),
                  block(rectangle(0, 1, 1, 3)), block(turned(rectangle(1.6, 1.4, 0.5, 0.4), 0.1))};
  for (int k = 0; k < 4; ++k) scene.blocks[static_cast<std::size_t>(k)].material = 1;
  scene.blocks[4].velocity = {7, 4};
  scene.blocks[4].angular_velocity = 3;
  return scene;
}

}  // namespace stability
