/// \file Blocks that slide over flush joints, down planes with crossings and into a shaft, against the motion
/// of one block on one face.
#include "chapters.hpp"

#include <tests/support/any_drops.hpp>
#include <tests/support/flush_joints.hpp>
#include <tests/support/scene_changes.hpp>

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace jointed_rock {

namespace {

using namespace ddacontact;
using namespace support;

constexpr double gravity = 9.8;  // m/s2

double tangent(double degrees) {
  return std::tan(degrees * std::numbers::pi / 180);
}

/// The speed at the end over what it should be, less 1; none: the run stops.
std::optional<double> error_of(const Scene& scene, int block, const Vec2& direction, double expected) {
  try {
    return final_speed(scene, block, direction) / expected - 1;
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::string text(const std::optional<double>& error) {
  return error ? fmt::format("{:.0e}", *error) : "stops";
}

/// What becomes of many runs against a bound.
struct Tally {
  double bound;
  int n = 0, n_within = 0;
  double largest = 0;

  void add(const std::optional<double>& error) {
    ++n;
    const double size = error ? std::abs(*error) : 1;
    n_within += size <= bound;
    largest = std::max(largest, size);
  }
  Claim claim(std::string said) const {
    return {std::move(said), n_within == n,
            fmt::format("{} of {}, largest error {:.0e}", n_within, n, largest)};
  }
};

/// The ways in which a scene is stated, with where its block and its direction go.
struct Statement {
  const char* name;
  Scene scene;
  int block;
  Vec2 direction;
};

std::vector<Statement> statements(const Scene& scene, const Vec2& direction) {
  const int n = static_cast<int>(scene.blocks.size());
  std::vector<int> backwards(scene.blocks.size());
  for (int b = 0; b < n; ++b) backwards[static_cast<std::size_t>(b)] = n - 1 - b;
  const Mat2 mirror = Vec2(-1, 1).asDiagonal(), turn = Eigen::Rotation2Dd(0.5).toRotationMatrix();
  return {{"as it is", scene, n - 1, direction},
          {"mirrored", turned(scene, mirror), n - 1, mirror * direction},
          {"turned by 0.5 rad", turned(scene, turn), n - 1, turn * direction},
          {"blocks and vertices renumbered", reordered(renumbered(scene, 1), backwards), 0, direction}};
}

double sliding_speed(const BrickRow& row, const JointedBlocks& blocks) {
  return row.speed - gravity * tangent(blocks.friction_angle) * blocks.duration;
}

void rows_of_bricks(Report& report) {
  report.paragraph(
      "A block of 1 m × 0.5 m slides at 3 m/s over ten bricks of 0.5 m with level tops, E = 1 GPa, 0.6 s. "
      "Free bricks lie on a base with friction of 45 degrees. Error of the speed, relative to 3 m/s (m/s "
      "less "
      "g tan φ t with friction):");
  std::vector<std::vector<std::string>> table{
      {"bricks", "gap", "φ", "Δt, ms", "as it is", "mirrored", "turned", "renumbered"}};
  Tally tally{1e-3};
  for (const bool free : {false, true})
    for (const double gap : {0.0, 1e-3})
      for (const double friction : {0.0, 10.0})
        for (const double time_step : {1e-2, 1e-3, 1e-4}) {
          const BrickRow row{.gap = gap, .free = free};
          const JointedBlocks blocks{
              .young = 1e9, .friction_angle = friction, .time_step = time_step, .duration = 0.6};
          table.push_back({free ? "free" : "fixed", fmt::format("{:g} mm", 1e3 * gap),
                           fmt::format("{:g}°", friction), fmt::format("{:g}", 1e3 * time_step)});
          for (const Statement& of : statements(sliding_over_bricks(row, blocks), Vec2(1, 0))) {
            if (time_step < 1e-3 && of.block != static_cast<int>(of.scene.blocks.size()) - 1) continue;
            const auto error = error_of(of.scene, of.block, of.direction, sliding_speed(row, blocks));
            tally.add(error);
            table.back().push_back(text(error));
          }
          table.back().resize(8, "");
        }
  report.table(table);
  std::vector<Claim> claims{tally.claim("Over flush joints the speed is within 1e-3 of that over one face.")};

  Tally far{1e-3};
  for (const bool free : {false, true}) {
    const BrickRow row{.n_bricks = 100, .free = free};
    const JointedBlocks blocks{.young = 1e9, .duration = 15};
    far.add(error_of(sliding_over_bricks(row, blocks), free ? 101 : 100, Vec2(1, 0), 3));
  }
  claims.push_back(far.claim("So it is after 90 of 100 bricks in a row, fixed and free."));

  Tally slow{1e-3};
  for (const double gap : {0.0, 1e-3})
    for (const double time_step : {1e-2, 1e-3}) {
      const BrickRow row{.gap = gap, .start = 1 + 3 * gap - gap - 1e-3, .speed = 0.01};
      const JointedBlocks blocks{.young = 1e9, .time_step = time_step, .duration = 0.3};
      slow.add(error_of(sliding_over_bricks(row, blocks), 10, Vec2(1, 0), 0.01));
    }
  claims.push_back(slow.claim("At 0.01 m/s a block crosses a joint that starts 1 mm before it."));
  report.claims(claims);
}

void steps_and_softness(Report& report) {
  report.paragraph(
      "The sixth brick and all after it are higher by a step. A corner passes a line when it is further "
      "behind it than 1e-4 of the smaller block's size, 0.7 m here. Steps below that are flush, higher ones "
      "stop the block, as a sharp step does. Speed after 0.3 s of 3 m/s, fixed bricks:");
  std::vector<std::vector<std::string>> table{{"step up", "Δt = 10 ms", "Δt = 1 ms"}};
  for (const double step : {1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3}) {
    table.push_back({fmt::format("{:g} m", step)});
    for (const double time_step : {1e-2, 1e-3}) {
      const BrickRow row{.step_up = step, .start = 1.2};
      const JointedBlocks blocks{.young = 1e9, .time_step = time_step, .duration = 0.3};
      const auto error = error_of(sliding_over_bricks(row, blocks), 10, Vec2(1, 0), 3);
      table.back().push_back(error ? fmt::format("{:.4f}", 3 * (1 + *error)) : "stops");
    }
  }
  report.table(table);

  report.paragraph(
      "Soft bricks sink under the block by more than that. Free bricks, no friction, 0.6 s: error of the "
      "speed");
  table = {{"E", "Δt = 10 ms", "Δt = 1 ms"}};
  for (const double young : {1e7, 3e7, 1e8, 3e8, 1e9, 1e10}) {
    table.push_back({fmt::format("{:g} MPa", 1e-6 * young)});
    for (const double time_step : {1e-2, 1e-3})
      table.back().push_back(text(error_of(
          sliding_over_bricks({.free = true}, {.young = young, .time_step = time_step, .duration = 0.6}), 11,
          Vec2(1, 0), 3)));
  }
  report.table(table);
}

/// The speed at the end, m/s, with corners rounded.
std::string rounded_speed(Scene scene, double rounding, int block, const Vec2& direction) {
  scene.contact.corner_rounding = rounding;
  const auto error = error_of(scene, block, direction, 1);
  return error ? fmt::format("{:.4f}", 1 + *error) : "stops";
}

/// What becomes of random drops with corners rounded: how many stop, substeps and tries given up.
std::vector<std::string> rounded_drops(double rounding, std::uint64_t n_drops) {
  int stopped = 0;
  long substeps = 0, rejected = 0;
  for (std::uint64_t seed = 0; seed < n_drops; ++seed) {
    Scene scene = any_drop(seed);
    scene.contact.corner_rounding = rounding;
    const BuiltScene built = build(scene);
    for (int k = 0; k < scene.n_steps(); ++k)
      if (!built.stepper->step()) {
        ++stopped;
        break;
      }
    substeps += built.stepper->counts().substeps;
    rejected += built.stepper->counts().rejected;
  }
  return {std::to_string(stopped), std::to_string(substeps), std::to_string(rejected)};
}

void rounded_corners(Report& report) {
  report.heading("Rounded corners");
  report.paragraph(
      "With `contact.corner_rounding` a corner that meets another block is an arc. Gap and normal are "
      "continuous where it leaves an edge or climbs a step, and no rule has to say which line it meets. What "
      "it meets keeps its sharp outline, so that flush joints stay flush. It needs steps in which a block "
      "moves less than about the radius; a smaller one catches on what bricks sink. Soft bricks, which sink "
      "by more than the lip of a sharp corner, slide on. Sharp corners are the default all the same: blocks "
      "turn over and arches hinge about the corner, and a rounded one is as much nearer to the middle as its "
      "radius. Final speed in m/s, Δt = 1 ms: 0.6 s over ten bricks at 3 m/s, 1 GPa and softer. Also 0.3 s "
      "down a crossed plane of 60° (2.5461) and into a shaft of its own width (2.94):");
  std::vector<std::vector<std::string>> table{
      {"rounding", "fixed", "fixed, gaps 1 mm", "free", "free, 100 MPa", "free, 35 MPa", "plane", "shaft"}};
  const double dip = 60 * std::numbers::pi / 180;
  for (const double rounding : {0.0, 1e-3, 3e-3, 1e-2, 3e-2}) {
    const auto over_bricks = [&](const BrickRow& row, double young) {
      const Scene scene = sliding_over_bricks(row, {.young = young, .time_step = 1e-3, .duration = 0.6});
      return rounded_speed(scene, rounding, static_cast<int>(scene.blocks.size()) - 1, Vec2(1, 0));
    };
    const JointedBlocks falling{.time_step = 1e-3, .duration = 0.3};
    table.push_back({fmt::format("{:g}", rounding), over_bricks({}, 1e9), over_bricks({.gap = 1e-3}, 1e9),
                     over_bricks({.free = true}, 1e9), over_bricks({.free = true}, 1e8),
                     over_bricks({.free = true}, 3.5e7),
                     rounded_speed(on_a_crossed_plane({.dip = 60}, falling), rounding, 3,
                                   Vec2(std::cos(dip), -std::sin(dip))),
                     rounded_speed(over_a_shaft(1e-6, falling), rounding, 2, Vec2(0, -1))});
  }
  report.table(table);
  report.paragraph("A hundred drops of blocks of any shape cost the same and need as many cuts:");
  table = {{"rounding", "stopped", "substeps", "tries given up"}};
  for (const double rounding : {0.0, 1e-3, 1e-2}) {
    table.push_back(rounded_drops(rounding, 100));
    table.back().insert(table.back().begin(), fmt::format("{:g}", rounding));
  }
  report.table(table);
}

void crossed_planes(Report& report) {
  Tally tally{0.01};
  std::vector<std::vector<std::string>> table{{"dip", "runs", "largest error"}};
  for (const double dip : {20.0, 40.0, 60.0, 80.0}) {
    Tally of_dip{0.01};
    for (const double crossing : {30.0, 60.0, 90.0, 120.0, 150.0})
      for (const double corner : {-1e-3, -1e-9, 0.0, 1e-6, 0.2})
        for (const double friction : {0.0, 10.0})
          for (const int n_blocks : {1, 2}) {
            const double time_step = corner == 0 ? 1e-3 : 1e-2;
            const JointedBlocks blocks{.friction_angle = friction, .time_step = time_step, .duration = 0.2};
            const double angle = dip * std::numbers::pi / 180;
            const double speed = gravity * (std::sin(angle) - std::cos(angle) * tangent(friction)) * 0.2;
            const auto error = error_of(on_a_crossed_plane({dip, crossing, corner, n_blocks}, blocks),
                                        2 + n_blocks, Vec2(std::cos(angle), -std::sin(angle)), speed);
            of_dip.add(error);
            tally.add(error);
          }
    table.push_back(
        {fmt::format("{:g}°", dip), fmt::format("{}", of_dip.n), fmt::format("{:.0e}", of_dip.largest)});
  }
  report.paragraph(
      "Planes are made of three fixed blocks' edges, with joints crossing them at 30 to 150 degrees. One or "
      "two blocks of 1 m × 0.3 m start from rest, the front corner at a crossing, 1 mm and 1 nm before it, 1 "
      "um and 0.2 m beyond. Friction is 0 and 10 degrees, E = 35 GPa. Speed after 0.2 s against g (sin α − "
      "cos α tan φ) t:");
  report.table(table);
  Tally models{0.01};
  for (const BlockModel model :
       {BlockModel::wachspress, BlockModel::mean_value, BlockModel::affine, BlockModel::mesh})
    for (const double dip : {30.0, 60.0}) {
      const double angle = dip * std::numbers::pi / 180;
      models.add(error_of(on_a_crossed_plane({.dip = dip}, {.duration = 0.2, .model = model}), 3,
                          Vec2(std::cos(angle), -std::sin(angle)), gravity * std::sin(angle) * 0.2));
    }
  report.claims({tally.claim("Blocks slide over crossings as over one face, within 1 %."),
                 models.claim("So do blocks of every model, corner on a crossing.")});
}

void shafts(Report& report) {
  Tally tally{1e-3};
  for (const double clearance : {0.0, 1e-9, 1e-6})
    for (const double time_step : {1e-2, 1e-3})
      for (const BlockModel model : {BlockModel::automatic, BlockModel::affine, BlockModel::mesh}) {
        const JointedBlocks blocks{.time_step = time_step, .duration = 0.3, .model = model};
        for (const Statement& of : statements(over_a_shaft(clearance, blocks), Vec2(0, -1)))
          tally.add(error_of(of.scene, of.block, of.direction, gravity * 0.3));
      }
  report.claims({tally.claim(
      "A block over the mouth of a shaft as wide as itself, or 1 nm or 1 um wider, falls freely.")});
}

}  // namespace

void flush_joints(Report& report) {
  report.heading("Flush joints");
  rows_of_bricks(report);
  steps_and_softness(report);
  crossed_planes(report);
  shafts(report);
  rounded_corners(report);
}

}  // namespace jointed_rock
