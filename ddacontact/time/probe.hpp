/// \file A place whose motion is recorded.
#pragma once

#include <ddacontact/block/rigid_velocity.hpp>
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

}  // namespace ddacontact
