/// \file Which joint law acts between which materials.
#pragma once

#include <ddacontact/contact/joint_law.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace ddacontact {

/// Mohr-Coulomb strengths of a joint, as stresses, or a friction law of one's own.
struct JointStrength {
  double friction = 0;          ///< tan(phi), >= 0
  double cohesion = 0;          ///< Pa, >= 0
  double tensile_strength = 0;  ///< Pa, >= 0
  FrictionLaw friction_law{};   ///< in place of Coulomb's N tan(phi); none: Coulomb
  /// Normal restitution of blocks that meet, [0, 1]: they collide as rigid bodies. None: they separate by
  /// their elasticity.
  std::optional<double> restitution{};
  double dashpot = 0;           ///< contact damping over critical damping of the contact spring, >= 0
  bool glued = false;           ///< contacts neither open nor slide once they are closed
  double normal_stiffness = 0;  ///< of the joint itself, Pa/m, >= 0; 0: it is rigid
  double shear_stiffness = 0;   ///< of the joint itself, Pa/m, >= 0; 0 where `normal_stiffness` is
  /// tan(phi), >= 0, of contacts that have slid or opened or were not closed at the start; none: `friction`.
  std::optional<double> residual_friction{};
  double dilation = 0;              ///< tan(i), >= 0: rise of a sliding contact over its slip
  double dilation_slip = 0;         ///< slip up to which a contact dilates, m, >= 0
  bool ductile = false;             ///< cohesion and tensile strength outlast slip, lost by opening alone
  double compressive_strength = 0;  ///< of the blocks at the joint, Pa, >= 0; 0: unlimited

  bool is_compliant() const { return normal_stiffness > 0; }
  bool damps() const { return dashpot > 0; }
  bool crushes() const { return compressive_strength > 0; }
  /// Whether its contacts act away from the corner, or close at a gap other than 0.
  bool shifts() const { return crushes() || dilation > 0; }
  bool operator==(const JointStrength&) const = default;
};

/// The strengths of the joint between any two materials.
class JointTable {
 public:
  /// The first joint without `between` is that of all pairs not named elsewhere; none: the first joint is.
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
  /// Largest rise by dilation over all joints, m: the gap that counts as none may be as wide.
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
