/// \file What slides down a plane under its weight and a force along the plane that sways.
#pragma once

#include <ddacontact/scene/scene.hpp>

namespace error_time {

/// A rigid body from rest on a plane; per mass the force is 1.5 m/s2 sin 4πt.
struct SwayingSlide {
  double slope, friction;  ///< degrees

  ddacontact::Vec2 down() const;
  /// The force on a block from the time `start` on, for `duration`, s; `density` in kg/m3.
  ddacontact::Load force(int block, double density, double start, double duration) const;
  /// Down the plane after the time t: a t²/2 + A (ωt − sin ωt)/ω², m.
  double way(double t) const;
};

}  // namespace error_time
