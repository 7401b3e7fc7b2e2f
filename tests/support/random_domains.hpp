/// \file Domains and what cuts them at random, the same for the same seed.
#pragma once

#include "random_simple_polygon.hpp"

#include <ddacontact/domain/domain.hpp>
#include <ddacontact/domain/opening_shapes.hpp>

namespace support {

/// About 20 m wide: two to five joint sets with deviations and rock bridges, up to three traces, two
/// openings, a region with an outline that cuts, and cells in it.
inline ddacontact::Domain random_domain(std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto number = [&](double from, double to) { return uniform(from, to, random); };
  const auto chance = [&](double part) { return number(0, 1) < part; };
  const auto count = [&](int from, int to) { return std::uniform_int_distribution<int>(from, to)(random); };
  const auto point = [&] { return Vec2(number(-10, 10), number(-10, 10)); };

  ddacontact::Domain domain;
  domain.seed = seed;
  domain.boundary = 10 * random_star(count(3, 12), random);
  if (chance(0.5)) domain.boundary = 10 * random_convex_polygon(count(3, 12), random);
  domain.keep_t_vertices = chance(0.5);
  const double size = number(1, 6);
  for (int s = count(2, 5); s > 0; --s) {
    ddacontact::JointSet set{.joint = s, .angle = number(-90, 90), .spacing = size * number(0.5, 2)};
    if (chance(0.3)) set.angle = 45 * count(0, 3);
    if (chance(0.5)) set.angle_deviation = number(0, 15);
    if (chance(0.5)) set.spacing_deviation = set.spacing * number(0, 0.5);
    if (chance(0.5)) {
      set.trace = size * number(1, 5);
      set.gap = size * number(0, 2);
      set.trace_deviation = set.trace * number(0, 0.5);
      set.gap_deviation = set.gap * number(0, 0.5);
    }
    if (chance(0.5)) set.origin = point();
    domain.joint_sets.push_back(set);
  }
  for (int t = count(0, 3); t > 0; --t) {
    Points line(2, count(2, 5));
    for (Index k = 0; k < line.cols(); ++k) line.col(k) = point();
    domain.traces.push_back({10, line});
  }
  for (int o = count(0, 2); o > 0; --o) {
    if (chance(0.5))
      domain.openings.push_back({ddacontact::circle_outline(point(), number(0.5, 3), count(3, 24)), 11});
    else
      domain.openings.push_back(
          {ddacontact::horseshoe_outline(point(), 3, number(1.5, 4), count(2, 12)), -1});
  }
  if (chance(0.3)) {
    domain.regions.push_back({(3 * random_convex_polygon(5, random)).colwise() + point(), true, 12});
    if (chance(0.5)) domain.voronoi.push_back({13, 0, count(2, 40)});
    if (chance(0.3)) domain.joint_sets.front().region = 0;
  }
  return domain;
}

}  // namespace support
