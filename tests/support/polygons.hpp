/// \file Rectangles and turned polygons.
#pragma once

#include <polyfem/core/types.hpp>

#include <Eigen/Geometry>

namespace support {

inline polyfem::Points rectangle(double x, double y, double width, double height) {
  polyfem::Points p(2, 4);
  p << x, x + width, x + width, x,  //
      y, y, y + height, y + height;
  return p;
}

inline polyfem::Points turned(const polyfem::Points& polygon, double angle,
                              const polyfem::Vec2& centre = polyfem::Vec2::Zero()) {
  const Eigen::Rotation2Dd R(angle);
  return (R.toRotationMatrix() * (polygon.colwise() - centre)).colwise() + centre;
}

}  // namespace support
