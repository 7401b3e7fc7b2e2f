/// \file A point whose motion is recorded.
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

/// A named point of a block, or its centroid, whose motion is recorded.
struct MonitorTarget {
  std::string name;
  std::variant<MaterialPoint, Centroid> target;

  int block() const {
    const auto* point = std::get_if<MaterialPoint>(&target);
    return point ? point->block : std::get<Centroid>(target).block;
  }
};

/// Position, displacement and velocity of a monitored point.
struct Motion {
  Vec2 position, displacement, velocity;  ///< position relative to the model's origin
};

/// The present motion of a monitored point. Of a centroid the velocity is momentum over mass.
Motion observe(const MonitorTarget& monitor, const Stepper& stepper);

}  // namespace ddacontact
