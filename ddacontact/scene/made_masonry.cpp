#include <ddacontact/scene/made_scenes.hpp>
#include <ddacontact/scene/scene_text.hpp>
#include <ddacontact/scene/text.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ddacontact {

namespace {

constexpr std::string_view stone = R"(
[[material]]
name    = "stone"
density = 2000.0              # kg/m3
young   = "5 GPa"
poisson = 0.2

[[joint]]
name = "dry joint"
friction_angle = 35.0         # degrees
)";

constexpr std::string_view of_stone = "material = \"stone\"\n", held = "material = \"stone\"\nfixed = true\n";

/// Where the bricks of a course end, its own ends first and last.
std::vector<double> brick_ends(const MadeWall& o, int course, double left, double right) {
  const double shift = o.running_bond && course % 2 == 1 ? o.brick_length / 2 : 0;
  std::vector<double> ends{left};
  for (double k = 0; k * o.brick_length + shift < right; ++k) {
    const double x = k * o.brick_length + shift;
    if (x > left + o.brick_length / 4 && x < right - o.brick_length / 4) ends.push_back(x);
  }
  ends.push_back(right);
  return ends;
}

/// Before any is made.
void expect_few(double blocks, const std::string& cure) {
  if (blocks > most_made_blocks)
    throw Error("there would be about " + scene_format::rounded(blocks) + " blocks (at most " +
                scene_format::short_number(most_made_blocks) + ": " + cure + ")");
}

int n_courses(double height, const MadeWall& o) {
  return static_cast<int>(std::lround(height / o.brick_height));
}

/// Bricks are counted before they are laid, and the piece beside the lintel is a quarter of a brick at least.
void check(const MadeWall& o) {
  const double n = (std::floor(o.height / o.brick_height) + 1) * (std::floor(o.length / o.brick_length) + 1);
  expect_few(n, "longer and higher bricks or a smaller wall make fewer");
  const double beside = 1.5 * o.brick_length, widest = o.length - beside;
  if (o.door_width > 0 && o.door_width > widest)
    throw Error("a wall of the length " + text_of(o.length) + " m has no room for a door of " +
                text_of(o.door_width) + " m and bricks of " + text_of(o.brick_length) +
                " m beside it (make the length at least " + text_of(o.door_width + beside) +
                " m, or the door width " + (widest > 0 ? "at most " + text_of(widest) + " m, or " : "") +
                "0 for none)");
  if (o.door_width > 0 && n_courses(o.door_height, o) >= n_courses(o.height, o))
    throw Error("a wall of the height " + text_of(o.height) + " m has no room for a lintel over a door of " +
                text_of(o.door_height) + " m (make the height at least " +
                text_of(o.door_height + o.brick_height) + " m, or the door width 0 for none)");
}

}  // namespace

std::string made_scene(const MadeWall& o) {
  check(o);
  const int n_all = std::max(1, n_courses(o.height, o)),
            n_door = o.door_width > 0 ? n_courses(o.door_height, o) : 0;
  const double door = (o.length - o.door_width) / 2, bearing = o.brick_length / 2;
  std::string text =
      head_text("Wall of bricks",
                "mode      = \"static\"\nsteps     = 20\ntime_step = 0.01              # s\n") +
      std::string(stone) +
      block_text("ground", rectangle(-o.brick_length, -o.brick_height, o.length + o.brick_length, 0), held);
  for (int c = 0; c < n_all; ++c) {
    const double bottom = c * o.brick_height, top = (c + 1) * o.brick_height;
    int n_bricks = 0;
    const auto lay = [&](double left, double right) {
      const std::vector<double> ends = brick_ends(o, c, left, right);
      for (std::size_t k = 0; k + 1 < ends.size(); ++k)
        text += block_text("b." + std::to_string(c) + "." + std::to_string(n_bricks++),
                           rectangle(ends[k], bottom, ends[k + 1], top), of_stone);
    };
    if (n_door == 0 || c > n_door) {
      lay(0, o.length);
    } else if (c < n_door) {
      lay(0, door);
      lay(door + o.door_width, o.length);
    } else {
      lay(0, door - bearing);
      text += block_text("lintel", rectangle(door - bearing, bottom, door + o.door_width + bearing, top),
                         of_stone);
      lay(door + o.door_width + bearing, o.length);
    }
  }
  return text;
}

std::string made_scene(const MadeArch& o) {
  expect_few(o.voussoirs * (o.fill ? 2. : 1.), "fewer voussoirs, each with its fill");
  const double inner = o.span / 2, outer = inner + o.thickness, foot = -o.thickness / 2,
               top = outer + o.thickness / 2;
  std::vector<Vec2> intrados, extrados;  // from the right
  for (int k = 0; k <= o.voussoirs; ++k) {
    const double angle = std::numbers::pi * k / o.voussoirs;
    Vec2 direction(std::cos(angle), std::sin(angle));
    if (k == o.voussoirs) direction << -1, 0;
    intrados.emplace_back(inner * direction);
    extrados.emplace_back(outer * direction);
  }
  std::string text =
      head_text("Masonry arch",
                "mode      = \"static\"\nsteps     = 20\ntime_step = 0.01              # s\n") +
      std::string(stone);
  if (o.fill)
    text += "\n[[material]]\nname    = \"fill\"\ndensity = 1800.0\nyoung   = \"100 MPa\"\npoisson = 0.3\n";
  text += block_text("right springer", rectangle(inner, foot, outer, 0), held) +
          block_text("left springer", rectangle(-outer, foot, -inner, 0), held);
  for (int k = 0; k < o.voussoirs; ++k)
    text += block_text("v" + std::to_string(k), {intrados[k], extrados[k], extrados[k + 1], intrados[k + 1]},
                       of_stone);
  text += "\n[[monitor]]\nname  = \"crown\"\nblock = \"v" + std::to_string(o.voussoirs / 2) +
          "\"\nat    = \"centroid\"\n";
  if (!o.fill) return text;
  text += block_text("right abutment", rectangle(outer, foot, outer + o.thickness, top), held) +
          block_text("left abutment", rectangle(-outer - o.thickness, foot, -outer, top), held);
  for (int k = 0; k < o.voussoirs; ++k) {
    const Vec2 right = extrados[k], left = extrados[k + 1];
    text += block_text("f" + std::to_string(k), {left, right, {right.x(), top}, {left.x(), top}},
                       "material = \"fill\"\n");
  }
  return text;
}

std::string made_scene(const MadeColumn& o) {
  std::string text =
      head_text("Column of drums",
                "mode      = \"static\"\nsteps     = 20\ntime_step = 0.01              # s\n") +
      std::string(stone) + block_text("ground", rectangle(-o.diameter, -o.drum, o.diameter, 0), held);
  for (int k = 0; k < o.drums; ++k)
    text += block_text("drum" + std::to_string(k),
                       rectangle(-o.diameter / 2, k * o.drum, o.diameter / 2, (k + 1) * o.drum), of_stone);
  return text + "\n[[monitor]]\nname  = \"top\"\nblock = \"drum" + std::to_string(o.drums - 1) +
         "\"\nat    = \"centroid\"\n";
}

}  // namespace ddacontact
