/// \file A wedge between two planes.
#include "chapters.hpp"
#include "slider.hpp"

#include <fmt/format.h>
#include <ddacontact/output/frame.hpp>
#include <ddacontact/picture/picture.hpp>
#include <ddacontact/scene/builder.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace validation {

namespace {

constexpr double wedge_height = 2;

/// A wedge, its point down, between two fixed planes.
struct Groove {
  double left, right;  ///< inclinations of the planes to the horizontal, degrees
  bool blunt;          ///< a trapezoid, else a triangle
  double friction;     ///< degrees

  double angle(int side) const { return radians(side == 0 ? left : right); }
  /// Up the plane.
  Vec2 up(int side) const {
    const double a = angle(side);
    return {side == 0 ? -std::cos(a) : std::cos(a), std::sin(a)};
  }
  /// From the plane into the wedge.
  Vec2 normal(int side) const {
    const double a = angle(side);
    return {side == 0 ? std::sin(a) : -std::sin(a), std::cos(a)};
  }
};

Points polygon(const std::vector<Vec2>& corners) {
  Points points(2, static_cast<Index>(corners.size()));
  for (std::size_t k = 0; k < corners.size(); ++k) points.col(static_cast<Index>(k)) = corners[k];
  return points;
}

/// Block 0 is the left plane, 1 the right one, 2 the wedge. The planes touch its faces over a part of their
/// length.
Scene groove_scene(const Groove& groove) {
  Scene scene = rock_scene(0.1, 30);
  scene.analysis.mode = Mode::statics;
  scene.joints[0].friction_angle = groove.friction;
  for (int side = 0; side < 2; ++side) {
    const double length = wedge_height / std::sin(groove.angle(side));
    const Vec2 low = 0.25 * length * groove.up(side), high = 0.8 * length * groove.up(side),
               back = -0.6 * groove.normal(side);
    scene.blocks.push_back(block(polygon({low, high, high + back, low + back}), true));
  }
  const Vec2 left = wedge_height / std::sin(groove.angle(0)) * groove.up(0),
             right = wedge_height / std::sin(groove.angle(1)) * groove.up(1);
  scene.blocks.push_back(block(groove.blunt ? polygon({0.4 * left, 0.4 * right, right, left})
                                            : polygon({Vec2(0, 0), right, left})));
  return scene;
}

/// What a plane exerts on the wedge: across and up the plane, over the wedge's weight.
struct Reaction {
  double normal = 0, shear = 0;
};

std::array<Reaction, 2> reactions(const Groove& groove, const Stepper& stepper) {
  std::array<Reaction, 2> reactions;
  const double weight = stepper.blocks().block(2).mass_total() * gravity;
  for (const ContactRecord& contact : stepper.contacts()) {
    if (!contact.closed()) continue;
    const bool on_vertex = contact.pair.vertex_block == 2;
    const int side = on_vertex ? contact.pair.edge_block : contact.pair.vertex_block;
    const Range& of_edge = stepper.blocks().block(contact.pair.edge_block).vertices();
    const Points& position = stepper.state().position;
    const Vec2 along = (position.col(of_edge.first + (contact.pair.edge + 1) % of_edge.count) -
                        position.col(of_edge.first + contact.pair.edge))
                           .normalized();
    const double force = (on_vertex ? contact.shear : -contact.shear) / weight;
    reactions[static_cast<std::size_t>(side)].normal += contact.normal / weight;
    reactions[static_cast<std::size_t>(side)].shear += force * along.dot(groove.up(side));
  }
  return reactions;
}

void in_a_groove(Report& report) {
  report.paragraph("### In a groove");
  report.paragraph(
      "A wedge 2 m high, E = 35 GPa, set between two fixed planes in a static stage. Without friction its "
      "forces form a triangle: N₁ = W sin b₂/sin(b₁ + b₂), where b are the planes' inclinations. In a "
      "symmetric groove N = W/(2 sin α) with α = 90° − b, half the wedge's angle. With friction N is not "
      "determined by statics: of a symmetric wedge it lies between W/(2 (cos b ± sin b tan φ)). Normal and "
      "shear forces (up the plane) over the weight:");
  std::vector<std::vector<std::string>> rows{{"planes", "wedge", "φ", "N left", "T", "N right", "T",
                                              "N by formula", "error", "T/(N tan φ)", "out of balance"}};
  double smooth = 0, balance = 0;
  bool inside = true;
  for (const Groove& groove :
       {Groove{60, 60, false, 0}, Groove{60, 60, true, 0}, Groove{35, 35, false, 0}, Groove{35, 35, true, 0},
        Groove{55, 40, false, 0}, Groove{55, 40, true, 0}, Groove{30, 50, true, 0}, Groove{60, 60, false, 10},
        Groove{60, 60, true, 20}, Groove{35, 35, true, 10}, Groove{55, 40, true, 15}}) {
    const BuiltScene built = run(groove_scene(groove));
    const std::array<Reaction, 2> found = reactions(groove, *built.stepper);
    Vec2 sum(0, -1);
    for (int side = 0; side < 2; ++side) {
      const Reaction& reaction = found[static_cast<std::size_t>(side)];
      sum += reaction.normal * groove.normal(side) + reaction.shear * groove.up(side);
    }
    balance = std::max(balance, sum.norm());
    rows.push_back({fmt::format("{:g}°, {:g}°", groove.left, groove.right),
                    groove.blunt ? "trapezoid" : "triangle", fmt::format("{:g}°", groove.friction)});
    std::vector<std::string>& row = rows.back();
    for (const Reaction& reaction : found) {
      row.push_back(fmt::format("{:.6f}", reaction.normal));
      row.push_back(fmt::format("{:.4f}", reaction.shear));
    }
    const double mu = std::tan(radians(groove.friction));
    if (groove.friction == 0) {
      double error = 0;
      std::string expected;
      for (int side = 0; side < 2; ++side) {
        const double exact = std::sin(groove.angle(1 - side)) / std::sin(groove.angle(0) + groove.angle(1));
        error = std::max(error, std::abs(found[static_cast<std::size_t>(side)].normal / exact - 1));
        if (side == 0 || groove.left != groove.right)
          expected += fmt::format("{}{:.6f}", side == 0 ? "" : ", ", exact);
      }
      smooth = std::max(smooth, error);
      row.insert(row.end(), {expected, text(error), ""});
    } else {
      double used = 0;
      for (const Reaction& reaction : found)
        used = std::max(used, std::abs(reaction.shear) / (mu * reaction.normal));
      inside = inside && used <= 1 + 1e-9;
      std::string bounds;
      if (groove.left == groove.right) {
        const double b = groove.angle(0), least = 0.5 / (std::cos(b) + mu * std::sin(b)),
                     most = std::cos(b) > mu * std::sin(b) ? 0.5 / (std::cos(b) - mu * std::sin(b))
                                                           : std::numeric_limits<double>::infinity();
        bounds = fmt::format("{:.4f} to {:.4f}", least, most);
        for (const Reaction& reaction : found)
          inside = inside && reaction.normal >= least * (1 - 1e-9) && reaction.normal <= most * (1 + 1e-9);
      }
      row.insert(row.end(), {bounds, "", fmt::format("{:.4f}", used)});
    }
    row.push_back(text(sum.norm()));
  }
  report.table(rows);
  report.claims({{"Without friction the reactions are those of the triangle of forces, to 1e-5.",
                  smooth <= 1e-5, text(smooth)},
                 {"With friction they stay within their bounds.", inside, inside ? "they do" : "not all"},
                 {"They balance the weight to 1e-5.", balance <= 1e-5, text(balance)}});
}

/// A wedge that pushes two blocks apart, on a floor.
struct Pushing {
  double half_angle;          ///< of the wedge, degrees
  double on_wedge, on_floor;  ///< friction angles, degrees
  double time_step = 0.005;
};

constexpr double pushing_time = 0.2;  // s

/// Block 0 is the floor, 1 and 2 are the blocks left and right, 3 is the wedge.
Scene pushing_scene(const Pushing& pushing) {
  Scene scene =
      rock_scene(pushing.time_step, static_cast<int>(std::lround(pushing_time / pushing.time_step)));
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1].name = "floor";
  scene.joints[0].friction_angle = pushing.on_wedge;
  scene.joints.push_back(scene.joints[0]);
  scene.joints[1].friction_angle = pushing.on_floor;
  scene.joints[1].between = {0, 1};
  const double slope = std::tan(radians(pushing.half_angle));
  const auto face = [&](double y) { return 0.5 + (y - 1) * slope; };
  const Points right = polygon({{face(0.4), 0}, {4, 0}, {4, 2}, {face(2), 2}, {face(0.4), 0.4}});
  Points left = right;
  left.row(0) *= -1;
  scene.blocks = {block(rectangle(-8, -1, 16, 1), true), block(left), block(right),
                  block(polygon({{-face(1), 1}, {face(1), 1}, {face(2.5), 2.5}, {-face(2.5), 2.5}}))};
  scene.blocks[0].material = 1;
  return scene;
}

/// Of rigid bodies, m/s2: the blocks' outwards and the wedge's downwards.
struct Accelerations {
  double blocks = 0, wedge = 0;
};

Accelerations rigid_accelerations(const Pushing& pushing, double block_mass, double wedge_mass) {
  const double a = radians(pushing.half_angle), mu = std::tan(radians(pushing.on_wedge)),
               floor = std::tan(radians(pushing.on_floor));
  // N (cos a - mu sin a) - floor (M g + N (sin a + mu cos a)) = M x'', m y'' = m g - 2 N (sin a + mu cos a),
  // x'' = y'' tan a
  const double lifts = std::sin(a) + mu * std::cos(a),
               pushes = std::cos(a) - mu * std::sin(a) - floor * lifts;
  const double normal = block_mass * gravity * (std::tan(a) + floor) /
                        (pushes + 2 * block_mass / wedge_mass * std::tan(a) * lifts);
  const double down = std::max(0.0, gravity - 2 * normal * lifts / wedge_mass);  // friction may hold it
  return {down * std::tan(a), down};
}

void pushing_apart(Report& report) {
  report.paragraph("### Pushing two blocks apart");
  report.paragraph(
      "A wedge between two blocks on a floor, settled with friction of 89 degrees and let go. The wedge has "
      "the mass m, a block M. N and μN act on the wedge's faces, and the floor has the friction μ'. Rigid "
      "bodies have m y'' = m g − 2 N (sin α + μ cos α). For a block M x'' = N (cos α − μ sin α) − μ' (M g + "
      "N (sin α + μ cos α)). The two move together: x'' = y'' tan α. where y'' is not positive it rests. "
      "Accelerations from the ways after 0.2 s, m/s2; errors where it rests are in m/s2:");
  std::vector<std::vector<std::string>> rows{{"half angle", "φ on the wedge", "φ on the floor", "Δt, s",
                                              "wedge, exact", "computed", "error", "blocks, exact",
                                              "computed", "error"}};
  double worst = 0;
  for (const Pushing& of : {Pushing{20, 0, 0}, Pushing{20, 12, 0}, Pushing{20, 8, 10}, Pushing{32, 0, 0},
                            Pushing{32, 15, 5}, Pushing{32, 10, 12}})
    for (const double time_step : {0.01, 0.002}) {
      Pushing pushing = of;
      pushing.time_step = time_step;
      const BuiltScene built = settled(pushing_scene(pushing));
      Stepper& stepper = *built.stepper;
      std::array<Vec2, 4> start;
      for (int b = 1; b < 4; ++b) start[static_cast<std::size_t>(b)] = travel(stepper, b);
      run(stepper, static_cast<int>(std::lround(pushing_time / time_step)));
      const auto acceleration = [&](int b) -> Vec2 {
        return 2 * (travel(stepper, b) - start[static_cast<std::size_t>(b)]) / (pushing_time * pushing_time);
      };
      const Accelerations exact = rigid_accelerations(pushing, stepper.blocks().block(1).mass_total(),
                                                      stepper.blocks().block(3).mass_total());
      const double down = -acceleration(3).y(), left = -acceleration(1).x(), right = acceleration(2).x();
      const auto error = [&](double seen, double expected) {
        return expected > 0 ? std::abs(seen / expected - 1) : std::abs(seen);
      };
      const double wedge_error = error(down, exact.wedge),
                   block_error = std::max(error(left, exact.blocks), error(right, exact.blocks));
      worst = std::max({worst, wedge_error, block_error});
      rows.push_back({fmt::format("{:g}°", of.half_angle), fmt::format("{:g}°", of.on_wedge),
                      fmt::format("{:g}°", of.on_floor), fmt::format("{:g}", time_step),
                      fmt::format("{:.5f}", exact.wedge), fmt::format("{:.5f}", down), text(wedge_error),
                      fmt::format("{:.5f}", exact.blocks), fmt::format("{:.5f}", right), text(block_error)});
    }
  report.table(rows);
  report.claims({{"Accelerations are those of rigid bodies, to 1e-3.", worst <= 1e-3, text(worst)}});
}

}  // namespace

void wedge(Report& report) {
  report.heading("4. A wedge between two planes");
  in_a_groove(report);
  pushing_apart(report);
}

}  // namespace validation
