/// \file Outlines of tunnels, counter-clockwise.
#pragma once

#include <ddacontact/core/types.hpp>

namespace ddacontact {

/// A regular polygon whose corners lie on a circle.
Points circle_outline(const Vec2& centre, double radius, int n_edges);

/// A floor, two walls and half a circle above them.
/// \param[in] floor    its middle
/// \param[in] height   from the floor to the crown; at least half the width
/// \param[in] n_edges  of the roof
Points horseshoe_outline(const Vec2& floor, double width, double height, int n_edges);

}  // namespace ddacontact
