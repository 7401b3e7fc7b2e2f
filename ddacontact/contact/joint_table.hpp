/// \file Which joint law acts between which materials.
#pragma once

#include <ddacontact/contact/joint_law.hpp>

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
  double dashpot = 0;  ///< contact damping, ratio to critical of the contact spring
  bool glued = false;  ///< contacts neither open nor slide once they are closed
};

/// The strengths of the joint between any two materials.
class JointTable {
 public:
  /// The first joint without `between` is what everything not named elsewhere takes; none: the first joint.
  struct Entry {
    JointStrength strength;
    std::optional<std::array<int, 2>> between;  ///< materials, either order
  };
  explicit JointTable(std::vector<Entry> entries) : entries_(std::move(entries)) {}
  /// One joint for all contacts.
  explicit JointTable(JointStrength everywhere) : entries_{{std::move(everywhere), std::nullopt}} {}

  const std::vector<Entry>& entries() const { return entries_; }
  const JointStrength& between(int material_a, int material_b) const {
    const Entry* general = nullptr;
    for (const Entry& entry : entries_) {
      if (!entry.between) {
        if (!general) general = &entry;
        continue;
      }
      const auto [p, q] = *entry.between;
      if ((p == material_a && q == material_b) || (p == material_b && q == material_a)) return entry.strength;
    }
    return (general ? *general : entries_.front()).strength;
  }

 private:
  std::vector<Entry> entries_;
};

}  // namespace ddacontact
