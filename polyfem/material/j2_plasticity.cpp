#include <polyfem/material/j2_plasticity.hpp>

#include <cmath>

namespace polyfem {

PlasticStep j2_step(const J2Material& material, const Vec3& strain, const PlasticState& before) {
  using Eigen::Vector4d;
  const double mu = material.shear;
  const Vector4d one(1, 1, 1, 0), counts(1, 1, 1, 2);  // xy stands for yx as well
  const double volume = strain[0] + strain[1];
  const Vector4d total(strain[0], strain[1], 0, strain[2] / 2);
  const Vector4d trial = 2 * mu * (total - volume / 3 * one - before.strain);
  const double size = std::sqrt(trial.cwiseAbs2().dot(counts));
  const double yield = material.yield_stress + material.hardening * before.equivalent;
  const double excess = size - std::sqrt(2. / 3) * yield;

  PlasticStep step;
  step.state = before;
  double theta = 1, theta_n = 0;
  Vector4d n = Vector4d::Zero();
  if (excess > 0) {
    const double flow = excess / (2 * mu + 2. / 3 * material.hardening);
    n = trial / size;
    step.state.strain += flow * n;
    step.state.equivalent += std::sqrt(2. / 3) * flow;
    theta = 1 - 2 * mu * flow / size;
    theta_n = 1 / (1 + material.hardening / (3 * mu)) - (1 - theta);
  }
  const Vector4d stress = material.bulk * volume * one + theta * trial;
  step.stress << stress[0], stress[1], stress[3];
  step.stress_zz = stress[2];

  const Vec3 plane_one(1, 1, 0), plane_n(n[0], n[1], n[3]);
  const Mat3 identity = Vec3(1, 1, 0.5).asDiagonal();  // of strains with gamma_xy
  step.tangent = material.bulk * plane_one * plane_one.transpose() +
                 2 * mu * theta * (identity - plane_one * plane_one.transpose() / 3) -
                 2 * mu * theta_n * plane_n * plane_n.transpose();
  return step;
}

}  // namespace polyfem
