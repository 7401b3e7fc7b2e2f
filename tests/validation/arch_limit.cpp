#include "arch_limit.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace validation {

namespace {

using ddacontact::Vec2;

/// value + slope . (H, M)
struct Linear {
  double value = 0;
  Vec2 slope{0, 0};
  double operator()(const Vec2& at) const { return value + slope.dot(at); }
};

struct JointForces {
  Linear normal, shear, moment;
};

/// Area of a voussoir and the radius its centroid is at.
std::array<double, 2> area_and_radius(const ArchShape& arch) {
  const double inner = 1 - arch.thickness / 2, outer = 1 + arch.thickness / 2;
  const double half = std::numbers::pi / (2 * arch.n_voussoirs);
  const double squares = outer * outer - inner * inner, cubes = std::pow(outer, 3) - std::pow(inner, 3);
  if (arch.curved) return {half * squares, 2. / 3 * std::sin(half) / half * cubes / squares};
  return {0.5 * std::sin(2 * half) * squares, 2. / 3 * std::cos(half) * cubes / squares};
}

std::vector<JointForces> joint_forces(const ArchShape& arch) {
  const int n = arch.n_voussoirs;
  const auto [weight, radius] = area_and_radius(arch);
  const auto direction = [&](double joint) {
    const double angle = std::numbers::pi * joint / n;
    return Vec2(std::cos(angle), std::sin(angle));
  };
  std::vector<JointForces> joints;
  double above = 0.5 * n * weight;  // vertical force through the joint
  double first_moment = 0;          // of the weights before it, about the arch's centre
  for (int k = 0; k <= n; ++k) {
    const auto [c, s] = std::array{direction(k).x(), direction(k).y()};
    JointForces joint;
    joint.normal = {above * c, {s, 0}};
    joint.shear = {above * s, {-c, 0}};
    // M + (c_0 - c_k) x (-H, n w / 2) + the weights about the middle of the joint
    joint.moment = {(1 - c) * 0.5 * n * weight - first_moment + k * weight * c, {-s, 1}};
    joints.push_back(joint);
    first_moment += weight * radius * direction(k + 0.5).x();
    above -= weight;
  }
  return joints;
}

/// The part of a convex polygon where `linear` <= 0.
std::vector<Vec2> clipped(const std::vector<Vec2>& polygon, const Linear& linear) {
  std::vector<Vec2> kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 &from = polygon[k], &to = polygon[(k + 1) % polygon.size()];
    const double at_from = linear(from), at_to = linear(to);
    if (at_from <= 0) kept.push_back(from);
    if ((at_from < 0) != (at_to < 0) && at_from != at_to)
      kept.push_back(from + at_from / (at_from - at_to) * (to - from));
  }
  return kept;
}

}  // namespace

std::vector<ArchJoint> joints_that_hold(const ArchShape& arch, double friction) {
  const std::vector<JointForces> joints = joint_forces(arch);
  const double half = arch.thickness / 2, much = 100 * arch.thickness;
  std::vector<Vec2> thrusts{{0, -much}, {much, -much}, {much, much}, {0, much}};
  for (const JointForces& at : joints)
    for (const double sign : {1., -1.}) {
      const auto less = [sign](const Linear& a, double factor, const Linear& b) {  // sign a - factor b
        return Linear{sign * a.value - factor * b.value, sign * a.slope - factor * b.slope};
      };
      thrusts = clipped(thrusts, less(at.moment, half, at.normal));
      thrusts = clipped(thrusts, less(at.shear, friction, at.normal));
    }
  if (thrusts.empty()) return {};
  Vec2 middle(0, 0);
  for (const Vec2& thrust : thrusts) middle += thrust / static_cast<double>(thrusts.size());
  std::vector<ArchJoint> found;
  for (const JointForces& at : joints) {
    const double normal = at.normal(middle);
    found.push_back({normal, at.moment(middle) / (half * normal), at.shear(middle) / normal});
  }
  return found;
}

double least_thickness(int n_voussoirs, double friction, bool curved) {
  double falls = 0, stands = 1;
  while (stands - falls > 1e-9) {
    const double tried = (falls + stands) / 2;
    (joints_that_hold({n_voussoirs, tried, curved}, friction).empty() ? falls : stands) = tried;
  }
  return stands;
}

}  // namespace validation
