/// \file Which joint law acts between which materials.
#pragma once

#include <ddacontact/contact/joint_law.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace ddacontact {

/// Mohr-Coulomb strengths of a joint, as stresses, or a friction law of one's own.
struct JointStrength {
  double friction = 0;          ///< tan(phi)
  double cohesion = 0;          ///< Pa
  double tensile_strength = 0;  ///< Pa
  FrictionLaw friction_law{};   ///< in place of Coulomb's N tan(phi); none: Coulomb
  /// 0..1, normal, of blocks that meet: they collide as rigid bodies. None: they part as their elasticity has
  /// it.
  std::optional<double> restitution{};
  double dashpot = 0;           ///< contact damping, ratio to critical of the contact spring
  bool glued = false;           ///< contacts neither open nor slide once they are closed
  double normal_stiffness = 0;  ///< of the joint itself, Pa/m; 0: it is rigid
  double shear_stiffness = 0;   ///< likewise; 0 where `normal_stiffness` is
  /// tan(phi) of contacts that have slid or opened or were not closed at the start; none: `friction`.
  std::optional<double> residual_friction{};
  double dilation = 0;       ///< tan(i): a contact that slides rises by so much of its slip
  double dilation_slip = 0;  ///< up to which it does, m
  bool ductile = false;      ///< cohesion and tensile strength outlast slip, and are lost by opening alone
  double compressive_strength = 0;  ///< of what meets there, Pa; 0: unlimited

  bool is_compliant() const { return normal_stiffness > 0; }
  bool damps() const { return dashpot > 0; }
  bool crushes() const { return compressive_strength > 0; }
  /// Whether its contacts act elsewhere than at the corner, or close at another gap than none.
  bool shifts() const { return crushes() || dilation > 0; }
  bool operator==(const JointStrength&) const = default;
};

/// The strengths of the joint between any two materials.
class JointTable {
 public:
  /// The first joint without `between` is what everything not named elsewhere takes; none: the first joint.
  struct Entry {
    JointStrength strength;
    std::optional<std::array<int, 2>> between;  ///< materials, either order
    bool operator==(const Entry&) const = default;
  };
  explicit JointTable(std::vector<Entry> entries) : entries_(std::move(entries)) {}
  /// One joint for all contacts.
  explicit JointTable(JointStrength everywhere) : entries_{{std::move(everywhere), std::nullopt}} {}

  const std::vector<Entry>& entries() const { return entries_; }
  /// Whether some joint is so: any(&JointStrength::shifts).
  bool any(bool (JointStrength::*is)() const) const {
    return std::ranges::any_of(entries_, [is](const Entry& e) { return (e.strength.*is)(); });
  }
  /// What dilation may lift, m: the gap that counts as none may be so wide.
  double largest_rise() const {
    double rise = 0;
    for (const Entry& e : entries_) rise = std::max(rise, e.strength.dilation * e.strength.dilation_slip);
    return rise;
  }
  /// The number of the entry that two materials follow.
  int number_between(int material_a, int material_b) const {
    int general = -1;
    for (int e = 0; e < static_cast<int>(entries_.size()); ++e) {
      if (!entries_[e].between) {
        if (general < 0) general = e;
        continue;
      }
      const auto [p, q] = *entries_[e].between;
      if ((p == material_a && q == material_b) || (p == material_b && q == material_a)) return e;
    }
    return std::max(general, 0);
  }

 private:
  std::vector<Entry> entries_;
};

}  // namespace ddacontact
