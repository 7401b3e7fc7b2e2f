/// \file A place whose motion is recorded.
#pragma once

#include <ddacontact/time/stepper.hpp>

#include <string>
#include <variant>

namespace ddacontact {

struct Centroid {
  int block = 0;
};

struct Probe {
  std::string name;
  std::variant<MaterialPoint, Centroid> place;
};

struct Motion {
  Vec2 position, displacement, velocity;  ///< position relative to the model's origin
};

/// Where a probed place is now. Of a centroid the velocity is momentum over mass.
Motion observe(const Probe& probe, const Stepper& stepper);

/// A block's momentum over its mass, and its angular momentum about the centroid over its inertia.
struct RigidVelocity {
  Vec2 linear;
  double angular = 0;  ///< rad/s
};
RigidVelocity rigid_velocity(const Block& block, const VectorXd& velocity);

}  // namespace ddacontact
