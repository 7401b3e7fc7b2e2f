/// \file The same scene stated otherwise: moved, in other units, turned, mirrored, with other numbers.
///
/// Everything that has a place, a direction, a dimension or a number goes along: blocks, supports, loads,
/// monitors, stages, materials, joints, springs, damping, meshes. Physically nothing changes.
#pragma once

#include <ddacontact/scene/builder.hpp>

#include <vector>

namespace support {

using ddacontact::Mat2;
using ddacontact::Points;
using ddacontact::Scene;
using ddacontact::Vec2;

/// All places by as much, m.
Scene moved(Scene scene, const Vec2& by);

/// Every vertex, load and monitor on the grid of multiples of `spacing`, m.
Scene on_grid(Scene scene, double spacing);

/// What the units of length, mass and time are multiplied by. The thickness of 1 m stays: masses are per
/// metre of it, so that densities are mass/length^2 and stresses mass/time^2.
struct Units {
  double length = 1, mass = 1, time = 1;
};
Scene scaled(Scene scene, const Units& by);

/// By an orthogonal matrix: turned, or mirrored where its determinant is -1. Supports that hold one axis can
/// be turned by quarters and mirrored on an axis only; Error otherwise.
Scene turned(Scene scene, const Mat2& by);

/// Every coordinate by its last digit, up, down or not at all, by lot: what is not in the scene but in how
/// its numbers are rounded.
Scene shaken(Scene scene, unsigned seed);

/// Vertex k of each block becomes number (k + shift) modulo n; or the other way round.
Scene renumbered(Scene scene, int shift, bool other_way = false);

/// Block b becomes number order[b].
Scene reordered(Scene scene, const std::vector<int>& order);

/// By how much the scene's vertices have moved, block by block in the scene's order, m.
std::vector<Points> vertex_displacements(const ddacontact::BuiltScene& built);

}  // namespace support
