#include <ddacontact/contact/joint_law.hpp>

namespace ddacontact {

double friction_rate(const JointLaw& law, double normal_force, bool bonded) {
  if (bonded && normal_force < 0) return 0;
  if (!law.friction_law || normal_force <= 0) return law.friction;
  const double step = 1e-6 * normal_force;
  return (shear_bound(law, normal_force + step, false) - shear_bound(law, normal_force - step, false)) /
         (2 * step);
}

}  // namespace ddacontact
