/// \file Coulomb's law of one contact in a step: which impulses go with which velocities.
///
/// With the velocity u at which the gap opens at the end of the step (what is left of the gap over dt
/// included), the velocity v of the slip, and the impulses p and q on them:
///     0 <= u + c_n p  perp  p >= 0,      |q| <= F(p),  q = -F(p) sign(w) where w = v + c_t q is not zero.
/// A bonded contact neither opens nor slides: u + c_n p = 0, v + c_t q = 0. Everything that solves or judges
/// contacts takes the law from here.
#pragma once

#include <ddacontact/contact/joint_law.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

/// Impulses of a contact per metre of thickness, N s/m; or what goes with them: velocities, m/s.
struct NormalAndShear {
  double normal = 0, shear = 0;
};

/// The law of one contact over a step whose impulses act during `time`.
struct CoulombLaw {
  double friction = 0;                                 ///< tan(phi)
  const FrictionLaw* friction_law = nullptr;           ///< of forces, in place of tan(phi); not owned
  double time = 1;                                     ///< force = impulse / time, s
  double normal_compliance = 0, shear_compliance = 0;  ///< c_n, c_t, m/s per N s/m, >= 0; 0: rigid
  bool bonded = false;                                 ///< neither opens nor slides, whatever it bears

  /// F(p): 0 for p <= 0.
  double bound(double normal) const {
    if (normal <= 0) return 0;
    return friction_law ? time * (*friction_law)(normal / time) : friction * normal;
  }
  /// dF/dp; of a friction law by a central difference. At p <= 0: tan(phi).
  double bound_rate(double normal) const {
    if (!friction_law || normal <= 0) return friction;
    constexpr double relative_step = 1e-6;  // cube root of round-off, about; F need not be differentiable
    const double step = relative_step * normal;
    return (bound(normal + step) - bound(normal - step)) / (2 * step);
  }
  /// Whether a shear impulse can act at all.
  bool has_friction() const { return bonded || friction > 0 || friction_law; }

  /// The impulses nearest to `trial` that the law allows: the normal one first, then the shear one within the
  /// bound of that.
  NormalAndShear project(const NormalAndShear& trial) const {
    if (bonded) return trial;
    const double normal = std::max(trial.normal, 0.0), largest = bound(normal);
    return {normal, std::clamp(trial.shear, -largest, largest)};
  }
  /// How far impulses are from obeying the law at velocities (u, v): p - project(p - (u + c p) / (w + c)),
  /// the natural map, N s/m; the shear impulse is compared with the bound of p. Zero exactly where the law
  /// holds. It is divided by w + c because that is what an error of p makes of u + c p: a compliant contact
  /// is judged by its impulse like a rigid one.
  /// \param[in] response  w > 0: the change of u and v by a unit of p and q alone, m/s per N s/m
  NormalAndShear residual(const NormalAndShear& impulse, const NormalAndShear& velocity,
                          const NormalAndShear& response) const {
    const double u = (velocity.normal + normal_compliance * impulse.normal) /
                     (response.normal + normal_compliance),
                 v = (velocity.shear + shear_compliance * impulse.shear) /
                     (response.shear + shear_compliance);
    if (bonded) return {u, v};
    const double largest = bound(impulse.normal);
    return {impulse.normal - std::max(0.0, impulse.normal - u),
            impulse.shear - std::clamp(impulse.shear - v, -largest, largest)};
  }
};

}  // namespace ddacontact
