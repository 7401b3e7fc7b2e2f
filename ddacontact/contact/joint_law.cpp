#include <ddacontact/contact/joint_law.hpp>

#include <cmath>
#include <limits>

namespace ddacontact {

double friction_rate(const JointLaw& law, double normal_force, bool bonded) {
  if (bonded && normal_force < 0) return 0;
  if (!law.friction_law || normal_force == 0) return law.friction;
  // Of central differences: as much is lost by curvature as by round-off.
  const double step = std::cbrt(std::numeric_limits<double>::epsilon()) * normal_force;
  return (extended_bound(law, normal_force + step, false) - extended_bound(law, normal_force - step, false)) /
         (2 * step);
}

}  // namespace ddacontact
