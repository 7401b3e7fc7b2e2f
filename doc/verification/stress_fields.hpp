/// \file Stresses inside blocks, cell by cell, against closed forms; scenes that call for them.
#pragma once

#include "mechanics_scenes.hpp"

#include <ddacontact/output/frame.hpp>

#include <functional>

namespace verification {

/// (xx, yy, xy), Pa, at a point of the scene.
using StressField = std::function<Vec3(const Vec2&)>;

/// Calls `visit(point, weight, stress)` at integration points (exact to degree 5 on triangles) of every cell
/// of a block; the weights sum to its area.
void for_each_stress(const Frame& frame, int block,
                     const std::function<void(const Vec2&, double, const Vec3&)>& visit);

/// How far the stress of a block is from `exact` where `counts` says so, in the energy norm, relative.
double stress_error(const Frame& frame, int block, const StressField& exact,
                    const std::function<bool(const Vec2&)>& counts = {});
/// The area mean of the stress within `radius` of a point.
Vec3 mean_stress_near(const Frame& frame, int block, const Vec2& point, double radius);

/// One block without gravity or contacts, E = 1 GPa, in four static steps of 1 s.
Scene static_scene(const BlockDescription& block, double poisson);
/// Adds forces (N per m2) on the straight line between two points of the outline of block 0: its integral by
/// two Gauss points on each of 64 parts.
void add_traction(Scene& scene, const Vec2& from, const Vec2& to,
                  const std::function<Vec2(const Vec2&)>& traction);

BlockDescription meshed(const Points& vertices, CellKind kind, int cells, bool edge_nodes = true);
/// The present stresses and contacts.
Frame frame_of(const BuiltScene& built);
int n_cells(const BuiltScene& built, int block = 0);

}  // namespace verification
