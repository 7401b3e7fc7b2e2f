#include <ddacontact/contact/joint_law.hpp>

#include <algorithm>
#include <cassert>

namespace ddacontact {

double shear_bound(const JointLaw& law, double normal_force, bool bonded) {
  assert(law.friction >= 0 && law.cohesion >= 0);
  const double N = std::max(0.0, normal_force);
  return (law.friction_law ? (*law.friction_law)(N) : N * law.friction) + (bonded ? law.cohesion : 0.0);
}

double friction_rate(const JointLaw& law, double normal_force, bool bonded) {
  if (bonded && normal_force < 0) return 0;
  if (!law.friction_law || normal_force <= 0) return law.friction;
  const double step = 1e-6 * normal_force;
  return (shear_bound(law, normal_force + step, false) - shear_bound(law, normal_force - step, false)) /
         (2 * step);
}

}  // namespace ddacontact
