/// \file Scenes of any number of blocks, for programs and tests that measure steps.
///
/// Rock of 10 GPa, 2500 kg/m3 and Poisson's ratio 0.2, friction of 35 degrees without cohesion unless a scene
/// says otherwise, default mechanics, sudden gravity. Blocks are about 1 m2, or 1 m x 0.5 m. `n` is about how
/// many blocks can move; the scenes round it to what their layout asks for.
#pragma once

#include <ddacontact/scene/scene.hpp>

#include <span>
#include <string>

namespace performance {

using namespace ddacontact;

/// Running bond upon a slab, as many rows as bricks in a row, half bricks at both ends of every second row.
Scene brick_wall(int n);
/// The same on a floor that dips by 20 degrees, with 10 degrees of friction there: once settled it glides
/// down as a whole.
Scene gliding_wall(int n);
/// A semicircle of n voussoirs upon two fixed springers, a fifth of its radius thick.
Scene arch(int n);
/// Convex blocks that fill a box whose floor and sides are held, shrunk about their centroids by `gap` of
/// their size: 0 where they rest upon each other from the start.
Scene voronoi_heap(int n, double gap = 0);
/// The heap at rest without friction.
Scene smooth_heap(int n);
/// A slope of 60 degrees cut by two sets of joints; the layers dip out of it by 20 degrees.
Scene jointed_slope(int n);
/// The same with 15 degrees of friction: the layers slide out.
Scene sliding_slope(int n);
/// Convex blocks that fall into a bin by a metre and more, with gaps of 15 % between them.
Scene falling_polygons(int n);
/// Convex blocks in a box with a hole in the middle, three tenths of the box wide.
Scene tunnel(int n);
/// A segmental arch of 120 degrees between fixed springers, with a block of fill upon each voussoir.
Scene filled_arch(int n);
/// Pentagons that fall apart from each other, turned and thrown at random: no contacts.
Scene rain(int n);
/// n bricks that rest apart from each other on shelves, and one that slides over a shelf of its own at 1 m/s
/// with 5 degrees of friction.
Scene field_with_mover(int n);
/// Running bond of columns, lying, eight times as long as thick, with rounded corners: 16 vertices.
Scene long_polygons(int n);

/// A scene by its name.
struct SceneKind {
  const char* name;
  Scene (*make)(int n);
};
/// All of them: "wall", "glide", "arch", "heap", "loose_heap", "smooth_heap", "slope", "slide", "bin",
/// "tunnel", "filled_arch", "rain", "field", "columns".
std::span<const SceneKind> scene_kinds();
/// Throws Error for an unknown name.
Scene make_scene(const std::string& kind, int n);

/// The scene in steps of this length, s, however many.
void set_time_step(Scene& scene, double time_step);
/// A few static steps before the first dynamic one: the scene starts from its equilibrium, without its
/// velocities.
void settle_first(Scene& scene);
/// Classical DDA: the paper's preset with blocks of six unknowns.
void make_classic(Scene& scene);

}  // namespace performance
