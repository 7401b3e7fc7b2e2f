#include <polyfem/material/isotropic_damage.hpp>

#include <algorithm>
#include <cmath>

namespace polyfem {

DamageStep damage_step(const DamageMaterial& material, const Vec3& strain, double largest_strain_before) {
  const Mat3& D = material.elasticity;
  const Vec3 elastic_stress = D * strain;
  const double equivalent = std::sqrt(std::max(0., strain.dot(elastic_stress)) / material.young);

  DamageStep step;
  step.largest_strain = std::max(equivalent, largest_strain_before);
  const double k = std::max(step.largest_strain, material.onset);
  const double intact = material.onset / k * std::exp(-(k - material.onset) / material.softening);
  step.damage = 1 - intact;
  step.stress = intact * elastic_stress;
  step.tangent = intact * D;
  if (equivalent > largest_strain_before && equivalent > material.onset)
    step.tangent -= intact * (1 / k + 1 / material.softening) / (material.young * k) * elastic_stress *
                    elastic_stress.transpose();
  return step;
}

}  // namespace polyfem
