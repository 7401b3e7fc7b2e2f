#include <polyfem/core/error.hpp>
#include <polyfem/material/neo_hooke.hpp>

#include <Eigen/LU>

#include <cmath>
#include <string>

namespace polyfem {
namespace {

void require_volume(double J) {
  if (!(J > 0))
    throw Error("the material is turned inside out (det F = " + std::to_string(J) +
                "): take smaller load steps");
}

}  // namespace

FiniteStress neo_hooke(double lambda, double mu, const Mat2& F) {
  const double J = F.determinant();
  require_volume(J);
  const Mat2 inverse = F.inverse();
  const double log_J = std::log(J);
  FiniteStress stress;
  stress.P = mu * F + (lambda * log_J - mu) * inverse.transpose();
  stress.tangent = mu * Mat4::Identity();
  for (int L = 0; L < 2; ++L)
    for (int k = 0; k < 2; ++k)
      for (int b = 0; b < 2; ++b)
        for (int i = 0; i < 2; ++i)
          stress.tangent(2 * b + i, 2 * L + k) +=
              lambda * inverse(b, i) * inverse(L, k) + (mu - lambda * log_J) * inverse(b, k) * inverse(L, i);
  return stress;
}

VolumeStress neo_hooke_volume(double lambda, double J) {
  require_volume(J);
  return {lambda * std::log(J) / J, lambda * (1 - std::log(J)) / (J * J)};
}

}  // namespace polyfem
