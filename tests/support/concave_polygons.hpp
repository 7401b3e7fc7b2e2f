/// \file Polygons with concave and straight corners, counter-clockwise.
#pragma once

#include <polyfem/core/types.hpp>

#include <initializer_list>
#include <string>
#include <vector>

namespace support {

struct NamedPolygon {
  std::string name;
  polyfem::Points points;
};

inline polyfem::Points points(std::initializer_list<polyfem::Vec2> vertices) {
  polyfem::Points polygon(2, static_cast<polyfem::Index>(vertices.size()));
  polyfem::Index k = 0;
  for (const polyfem::Vec2& vertex : vertices) polygon.col(k++) = vertex;
  return polygon;
}

/// All of unit size or so; the first four are star-shaped about their centroids.
inline std::vector<NamedPolygon> concave_polygons() {
  return {{"dart", points({{0, 0}, {2, 1}, {0, 2}, {0.5, 1}})},
          {"square with middles", points({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}})},
          {"triangle with a middle", points({{0, 0}, {1, 0}, {2, 0}, {0.5, 2}})},
          {"chevron", points({{0, 0}, {1, 0.3}, {2, 0}, {2, 1}, {1, 1.3}, {0, 1}})},
          {"L", points({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}})},
          {"deep notch", points({{0, 0}, {2, 0}, {2, 2}, {1.2, 2}, {1, 0.3}, {0.8, 2}, {0, 2}})},
          {"U with straight corners",
           points({{0, 0}, {1.5, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1.5, 1}, {1, 1}, {1, 2}, {0, 2}})},
          {"comb", points({{0, 0},
                           {5, 0},
                           {5, 2},
                           {4, 2},
                           {4, 1},
                           {3, 1},
                           {3, 2},
                           {2, 2},
                           {2, 1},
                           {1, 1},
                           {1, 2},
                           {0, 2}})}};
}

}  // namespace support
