/// \file A place whose motion is recorded.
#pragma once

#include <ddacontact/block/rigid_velocity.hpp>
#include <ddacontact/time/stepper.hpp>

#include <string>
#include <variant>

namespace ddacontact {

/// A block's centre of mass.
struct Centroid {
  int block = 0;
};

/// A named place on a block.
struct Probe {
  std::string name;
  std::variant<MaterialPoint, Centroid> place;

  int block() const {
    const auto* point = std::get_if<MaterialPoint>(&place);
    return point ? point->block : std::get<Centroid>(place).block;
  }
};

/// Where a place is and how it moves.
struct Motion {
  Vec2 position, displacement, velocity;  ///< position relative to the model's origin
};

/// Where a probed place is now. Of a centroid the velocity is momentum over mass.
Motion observe(const Probe& probe, const Stepper& stepper);

}  // namespace ddacontact
