#include <ddacontact/scene/made_scenes.hpp>
#include <ddacontact/scene/scene_text.hpp>

#include <cmath>
#include <numbers>

namespace ddacontact {

namespace {

constexpr std::string_view rock = R"(
[[material]]
name    = "rock"
density = 2600.0              # kg/m3
young   = "20 GPa"
poisson = 0.25

[[joint]]
name = "cross joint"          # the first: what no joint set names
friction_angle = 35.0         # degrees

[[joint]]
name = "bedding"
friction_angle = 30.0
)";

constexpr std::string_view settled_first = R"(
[[stage]]                     # the rock settles with its joints glued
name  = "settle"
mode  = "static"
steps = 50
until = { kinetic = 1e-8, displacement = 1e-5 }
joints = { "cross joint" = { glued = true }, bedding = { glued = true } }
reset_displacements = true

[[stage]]                     # then they bear what they can; the rest is let go without a shock
name  = "release"
mode  = "static"
steps = 100
until = { kinetic = 1e-8, displacement = 1e-5 }

[[stage]]                     # what does not rest moves
name  = "motion"
steps = 100
)";

std::string joint_set(const std::string& joint, double angle, double spacing, const std::string& rest) {
  return "\n[[domain.joint_set]]\njoint   = \"" + joint + "\"\nangle   = " + text_of(angle) +
         "\nspacing = " + text_of(spacing) + '\n' + rest;
}

std::string fixed_region(const std::string& name, const std::vector<Vec2>& polygon) {
  return "\n[[domain.region]]\nname    = \"" + name + "\"\npolygon = " + text_of(polygon) +
         "\nfixed   = true\ncut     = true\n";
}

}  // namespace

std::string made_scene(const MadeSlope& o) {
  const double h = o.height, toe = h, level = h / 2, top = level + h, right = 3 * h, edge = h / 5,
               crest = toe + h / std::tan(o.face * std::numbers::pi / 180);
  return head_text("Rock slope", "time_step = 0.01              # s\n") + std::string(rock) +
         "\n[domain]                      # blocks cut by joints: d0, d1, ...\nboundary = " +
         text_of(
             std::vector<Vec2>{{0, 0}, {right, 0}, {right, top}, {crest, top}, {toe, level}, {0, level}}) +
         "\nmaterial = \"rock\"\nseed     = " + std::to_string(o.seed) + '\n' +
         joint_set("bedding", o.dip, o.spacing, "spacing_deviation = " + text_of(o.spacing / 5) + '\n') +
         joint_set("cross joint", o.dip - 90, o.spacing,
                   "trace   = " + text_of(5 * o.spacing) +
                       "             # long, with rock bridges of\ngap     = " + text_of(o.spacing / 2) +
                       '\n') +
         fixed_region("base", {{0, 0},
                               {right, 0},
                               {right, top},
                               {right - edge, top},
                               {right - edge, edge},
                               {edge, edge},
                               {edge, level},
                               {0, level}}) +
         std::string(settled_first);
}

std::string made_scene(const MadeTunnel& o) {
  const double w = o.width, h = o.height, right = 6 * w, top = 5 * h, edge = w / 3;
  return head_text("Tunnel in jointed rock", "time_step = 0.01              # s\n") + std::string(rock) +
         "\n[domain]                      # blocks cut by joints: d0, d1, ...\nboundary = " +
         text_of(rectangle(0, 0, right, top)) +
         "\nmaterial = \"rock\"\nseed     = " + std::to_string(o.seed) + '\n' +
         joint_set("bedding", 20, o.spacing, "spacing_deviation = " + text_of(o.spacing / 5) + '\n') +
         joint_set("cross joint", -65, o.spacing, "spacing_deviation = " + text_of(o.spacing / 5) + '\n') +
         "\n[[domain.opening]]\nname = \"tunnel\"\nhorseshoe = { floor = " +
         text_of(Vec2(right / 2, 1.5 * h)) + ", width = " + text_of(w) + ", height = " + text_of(h) +
         ", edges = 12 }\n" +
         fixed_region("base", {{0, 0},
                               {right, 0},
                               {right, top},
                               {right - edge, top},
                               {right - edge, edge},
                               {edge, edge},
                               {edge, top},
                               {0, top}}) +
         std::string(settled_first) + "remove = [{ group = \"tunnel\" }]  # while it is excavated\n";
}

}  // namespace ddacontact
