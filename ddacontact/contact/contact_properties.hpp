/// \file Properties of contacts apart from geometry.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/contact/contact.hpp>
#include <ddacontact/contact/joint_table.hpp>
#include <ddacontact/core/options.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace ddacontact {

/// Stiffnesses, joints and tolerances of all contacts.
struct ContactProperties {
  double normal_stiffness = 0;      ///< p, N/m per m
  double tangential_stiffness = 0;  ///< p bar, N/m per m
  JointTable joints;
  std::vector<int> materials;  ///< of each block
  ContactMethod method = standard_defaults.method;
  /// Largest penetration over the block size, >= 0; 0: plain penalty.
  double penetration_tolerance = standard_defaults.penetration_tolerance;
  /// A corner passes an edge's line when it is further behind it than this times the block size: joints are
  /// flush to that. Infinity, the paper's preset: lines are chosen by the geometry at the start of a step.
  double lip = default_lip;
  /// Largest residual over the forces on a block; none: see ContactSolverOptions.
  std::optional<double> tolerance = {};
  /// The joint of each edge of each block's outline, an entry of `joints`; -1: that of the materials. Empty:
  /// no edge has one.
  std::vector<std::vector<int>> edge_joints = {};
  static constexpr double default_lip = 1e-4, lip_of_paper = inf;

  /// Whether forces of contacts are multipliers: their springs store no energy.
  bool has_multipliers() const { return method == ContactMethod::staged && penetration_tolerance > 0; }
  /// The entry of `joints` that a contact follows: that of its edge, else of the two materials.
  int joint_of(const VertexEdge& pair) const {
    const int of_edge = edge_joints.empty() ? -1 : edge_joints[pair.edge_block][pair.edge];
    return of_edge >= 0 ? of_edge
                        : joints.number_between(materials[pair.vertex_block], materials[pair.edge_block]);
  }
  const JointStrength& strength(const VertexEdge& pair) const {
    return joints.entries()[joint_of(pair)].strength;
  }
  /// Whether forces follow the joint's own stiffness; where two joints meet, both have to have one.
  bool is_compliant(const ContactRecord& contact) const {
    return strength(contact.pair).is_compliant() && contact.history.length > 0 &&
           (!beyond(contact) || beyond(contact)->is_compliant());
  }
  bool is_glued(const ContactRecord& contact) const {
    return strength(contact.pair).glued || (beyond(contact) && beyond(contact)->glued);
  }
  /// A stress of the joint times the length of a contact, N/m: of each joint over its part.
  double over_length(const ContactRecord& contact, double JointStrength::*stress) const {
    const double length = contact.history.length, part = part_beyond(contact),
                 here = strength(contact.pair).*stress * length * (1 - part);
    return part > 0 ? here + beyond(contact)->*stress * length * part : here;
  }
  /// Law of a contact at the start of a step, with a bond's strength over the length of the contact. Of a
  /// closed contact of a glued joint that strength is infinite.
  JointLaw law(const ContactRecord& contact) const;
  /// Distance from the vertex at which the forces of a contact act, m: twice that length is crushed.
  double inset(const ContactRecord& contact) const;
  /// F += a contact's forces on the unknowns of its blocks.
  void add_forces(const BlockSystem& blocks, const BlockState& state, const ContactRecord& contact,
                  VectorXd& F) const;

 private:
  /// Strength of the joint on the part of a contact's length beyond its edge; null: there is no such part.
  const JointStrength* beyond(const ContactRecord& contact) const;
  static double part_beyond(const ContactRecord& contact) {
    const double beyond = std::abs(contact.history.length_beyond);
    return beyond == 0 ? 0 : std::min(1., beyond / contact.history.length);
  }
  /// tan(phi); where two joints meet the mean over the length.
  double friction_of(const ContactRecord& contact) const;
};

}  // namespace ddacontact
