#include "mechanics_chapters.hpp"
#include "mechanics_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace verification {

namespace {

constexpr std::array restitutions{0., 0.25, 0.5, 0.75, 1.};
constexpr std::array mean_force_schemes{Scheme::decaying, Scheme::midpoint};
const char* name(Scheme scheme) {
  return scheme == Scheme::midpoint ? "midpoint" : "decaying";
}

/// The speed after over that before the hit, of a block that meets the floor in its second step after the
/// given part of it.
double computed_restitution(Scheme scheme, double restitution, double dt, double phase) {
  constexpr double speed = 2, block_base = 1;
  const double hit = (1 + phase) * dt, gap = speed * hit + gravity * hit * hit / 2;
  Scene scene = rock_scene(dt, 4);
  scene.analysis.scheme = scheme;
  scene.joints[0].restitution = restitution;
  scene.blocks = {block(rectangle(-2, -1, 5, 1), true), block(rectangle(0, gap, block_base, 1))};
  scene.blocks[1].velocity = {0, -speed};
  const BuiltScene built = run(scene);
  const double falling = restitution == 0 ? 0 : gravity * (4 * dt - hit);
  return (velocity(*built.stepper, 1).y() + falling) / (speed + gravity * hit);
}

void on_the_floor(Report& report) {
  report.paragraph("### A block on the floor");
  report.paragraph(
      "A square of 1 m meets the floor flat at 2 m/s, at 20 phases of its second step; gravity acts. The "
      "speed with which "
      "it leaves over that with which it comes, largest difference from the restitution asked for over the "
      "phases:");
  std::vector<std::vector<std::string>> rows{{"scheme", "Δt, s"}};
  for (const double e : restitutions) rows[0].push_back(fmt::format("e = {:g}", e));
  double worst = 0;
  for (const Scheme scheme : mean_force_schemes)
    for (const double dt : {1e-5, 1e-4, 1e-3, 5e-3, 2e-2}) {
      std::vector<std::string> row{name(scheme), fmt::format("{:g}", dt)};
      for (const double e : restitutions) {
        double largest = 0;
        for (int phase = 0; phase < 20; ++phase)
          largest = std::max(largest, std::abs(computed_restitution(scheme, e, dt, (phase + 0.5) / 20) - e));
        row.push_back(text(largest));
        worst = std::max(worst, largest);
      }
      rows.push_back(row);
    }
  report.table(rows);
  report.claims({{"Restitution asked for to 0.02 at every step and phase.", worst <= 0.02, text(worst)}});
}

/// Largest changes in the course of a collision, relative to what there was.
struct Kept {
  double linear = 0, angular = 0, energy_up = -1;
  bool touched = false;
};

Kept collide(Scheme scheme, std::optional<double> restitution, double friction, double offset, double tilt,
             double dt) {
  Scene scene = rock_scene(dt, static_cast<int>(std::lround(0.3 / dt)));
  scene.analysis.gravity.setZero();
  scene.analysis.scheme = scheme;
  scene.joints[0].restitution = restitution;
  scene.joints[0].friction_angle = friction;
  scene.blocks = {block(rectangle(-1, -0.5, 1, 1)), block(turned(rectangle(-1, -0.5, 2, 1), tilt))};
  scene.blocks[1].vertices.colwise() += Vec2(1.3, offset);
  scene.blocks[0].velocity = {3, 0.2};
  scene.blocks[1].velocity = {-1, 0};
  scene.blocks[1].angular_velocity = tilt;
  const BuiltScene built = build(scene);
  Stepper& stepper = *built.stepper;
  const Momenta start = momenta(stepper);
  const double energy = mechanical_energy(stepper);
  Kept kept;
  for (int k = 0; k < scene.analysis.steps; ++k) {
    run(stepper, 1);
    const Momenta now = momenta(stepper);
    kept.linear = std::max(kept.linear, (now.linear - start.linear).norm() / start.sum_of_moduli);
    kept.angular =
        std::max(kept.angular, std::abs(now.angular - start.angular) / start.sum_of_moduli);  // per 1 m
    kept.energy_up = std::max(kept.energy_up, mechanical_energy(stepper) / energy - 1);
    kept.touched = kept.touched || stepper.counts().contacts_max > 0 ||
                   std::abs(now.sum_of_moduli / start.sum_of_moduli - 1) > 1e-3;
  }
  return kept;
}

void in_flight(Report& report) {
  report.paragraph("### Two free blocks");
  report.paragraph(
      "A square of 1 m meets a rectangle of 2 x 1 m head on (parallel sides), off centre, and obliquely "
      "(turned by 0.4 rad and turning). Friction is 0 and 30 degrees, restitution 0 to 1 or none (the "
      "decaying scheme: contacts alone), with steps of 20, 5 and 1 ms. The table has the largest changes "
      "over the restitutions and the steps: momentum over Σ |m v|, angular momentum over Σ |m v| times 1 m, "
      "energy over that at the start.");
  std::vector<std::vector<std::string>> rows{{"scheme", "collision", "friction", "restitution", "momentum",
                                              "angular momentum", "energy, highest change"}};
  struct Meeting {
    const char* name;
    double offset, tilt;
  };
  Kept worst;
  bool touched = true;
  for (const Scheme scheme : mean_force_schemes)
    for (const Meeting& meeting :
         {Meeting{"head on", 0, 0}, Meeting{"off centre", 0.4, 0}, Meeting{"oblique", 0.3, 0.4}})
      for (const double friction : {0., 30.})
        for (const bool is_stated : {true, false}) {
          if (!is_stated && scheme != Scheme::decaying) continue;
          std::vector<std::optional<double>> stated(restitutions.begin(), restitutions.end());
          if (!is_stated) stated = {std::nullopt};
          Kept largest;
          for (const std::optional<double>& e : stated)
            for (const double dt : {0.02, 0.005, 0.001}) {
              const Kept kept = collide(scheme, e, friction, meeting.offset, meeting.tilt, dt);
              largest.linear = std::max(largest.linear, kept.linear);
              largest.angular = std::max(largest.angular, kept.angular);
              largest.energy_up = std::max(largest.energy_up, kept.energy_up);
              touched = touched && kept.touched;
            }
          rows.push_back({name(scheme), meeting.name, fmt::format("{:g}°", friction),
                          is_stated ? "0 to 1" : "none", text(largest.linear), text(largest.angular),
                          text(largest.energy_up)});
          worst.linear = std::max(worst.linear, largest.linear);
          worst.angular = std::max(worst.angular, largest.angular);
          worst.energy_up = std::max(worst.energy_up, largest.energy_up);
        }
  report.table(rows);
  report.claims({{"The blocks meet in every run.", touched, touched ? "they do" : "they do not"},
                 {"Momentum stays to 1e-12 of Σ |m v|.", worst.linear <= 1e-12, text(worst.linear)},
                 {"Angular momentum stays to 1e-6.", worst.angular <= 1e-6, text(worst.angular)},
                 {"Energy is never up by 1e-6.", worst.energy_up <= 1e-6, text(worst.energy_up)}});
}

}  // namespace

void colliding(Report& report) {
  report.heading("4. Collisions");
  on_the_floor(report);
  in_flight(report);
}

}  // namespace verification
