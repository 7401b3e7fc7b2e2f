#include <ddacontact/scene/made_scenes.hpp>
#include <ddacontact/scene/scene_text.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace ddacontact {

namespace {

/// Corners at jittered angles on a circle: convex.
std::vector<Vec2> pebble(const Vec2& centre, double radius, std::mt19937_64& random) {
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const int n = 4 + static_cast<int>(4 * uniform());
  const double start = uniform();
  std::vector<Vec2> corners;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * (k + start + 0.6 * uniform()) / n;
    corners.emplace_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return corners;
}

}  // namespace

std::string made_scene(const MadeHeap& o) {
  const double pitch = 1.1 * o.size, wall = o.size / 2;
  const int n_columns = std::max(2, static_cast<int>(std::sqrt(o.blocks))),
            n_rows = (o.blocks + n_columns - 1) / n_columns;
  const double width = n_columns * pitch, height = n_rows * pitch;
  std::string text =
      head_text("Heap of blocks", "steps     = 200\ntime_step = 0.01              # s\n") + R"(
[[material]]
name    = "rock"
density = 2600.0              # kg/m3
young   = "1 GPa"
poisson = 0.25

[[joint]]
name = "rock on rock"
friction_angle = 30.0         # degrees
restitution = 0.1
)" + block_text("floor", rectangle(-wall, -wall, width + wall, 0), "material = \"rock\"\nfixed = true\n") +
      block_text("left wall", rectangle(-wall, 0, 0, height), "material = \"rock\"\nfixed = true\n") +
      block_text("right wall", rectangle(width, 0, width + wall, height),
                 "material = \"rock\"\nfixed = true\n");
  std::mt19937_64 random(static_cast<std::uint64_t>(o.seed));
  for (int k = 0; k < o.blocks; ++k) {
    const Vec2 centre((k % n_columns + 0.5) * pitch, (k / n_columns + 0.6) * pitch);
    text += block_text("p" + std::to_string(k), pebble(centre, o.size / 2, random));
  }
  return text;
}

}  // namespace ddacontact
