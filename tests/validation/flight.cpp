/// \file Free fall, a projectile and a spinning block.
#include "chapters.hpp"

#include <fmt/format.h>
#include <mechanics_scenes.hpp>

#include <algorithm>
#include <cmath>

namespace validation {

namespace {

using namespace verification;

constexpr double end_time = 1.25;  // s
const std::vector<double> time_steps{0.0125, 0.005, 0.0025};

Scene flight_scene(Scheme scheme, double dt, double time) {
  Scene scene = rock_scene(dt, static_cast<int>(std::lround(time / dt)));
  scene.analysis.scheme = scheme;
  scene.blocks = {block(pentagon())};
  return scene;
}

void thrown(Report& report) {
  report.paragraph(fmt::format(
      "### Free fall and a projectile\n\nA pentagon of 3.3 m2 is dropped from rest, and thrown at (7, 11) "
      "m/s without spin. After {:g} s it is at v t + g t²/2 and moves at v + g t. Distance from there (m), "
      "and error of the velocity (m/s). Schemes with constant acceleration within a step are exact. "
      "`backward_euler` moves by the velocity at the end of each step and is g t Δt/2 too low. `newmark` "
      "starts from no acceleration, which costs its first step half of g.",
      end_time));
  std::vector<std::vector<std::string>> rows{{"Δt, s"}};
  for (const NamedScheme& scheme : schemes) rows[0].push_back(scheme.name);
  double exact = 0, law = 0;
  for (const double dt : time_steps) {
    rows.push_back({fmt::format("{:g}", dt)});
    for (const NamedScheme& scheme : schemes) {
      double off = 0, off_velocity = 0;
      for (const Vec2& start : {Vec2(0, 0), Vec2(7, 11)}) {
        Scene scene = flight_scene(scheme.scheme, dt, end_time);
        scene.blocks[0].velocity = start;
        const BuiltScene built = run(scene);
        const Vec2 g(0, -gravity);
        off = std::max(off,
                       (travel(*built.stepper, 0) - end_time * start - end_time * end_time / 2 * g).norm());
        off_velocity = std::max(off_velocity, (velocity(*built.stepper, 0) - start - end_time * g).norm());
      }
      rows.back().push_back(fmt::format("{}, {}", text(off), text(off_velocity)));
      if (scheme.scheme == Scheme::decaying || scheme.scheme == Scheme::midpoint ||
          scheme.scheme == Scheme::dda)
        exact = std::max({exact, off, off_velocity});
      if (scheme.scheme == Scheme::backward_euler)
        law = std::max(law, std::abs(off / (gravity * end_time * dt / 2) - 1));
    }
  }
  report.table(rows);
  report.claims(
      {{"Decaying, midpoint and dda: the parabola to 1e-11 m and m/s.", exact <= 1e-11, text(exact)},
       {"Backward Euler is off by its law, to 1e-6 of it.", law <= 1e-6, text(law)}});
}

void spun(Report& report) {
  constexpr double spin = 4;  // rad/s
  constexpr int turns = 5;
  report.paragraph(
      fmt::format("### A spinning block\n\nThe same pentagon turns {} times at {} rad/s, without gravity. "
                  "Its period over 2π/ω less 1, next to "
                  "what tan(θ/2) = ωΔt/2 makes of it with midpoint; the decaying scheme turns by ωΔt a step. "
                  "Largest change of its area, of which up to 1e-6 is its "
                  "centrifugal stretch and the vibration that comes of "
                  "starting unstretched; largest change of angular momentum.",
                  turns, spin));
  std::vector<std::vector<std::string>> rows{
      {"scheme", "Δt, s", "period", "law", "area", "angular momentum"}};
  double period_off = 0, area = 0, momentum = 0;
  for (const auto& [name, scheme] :
       {NamedScheme{"decaying", Scheme::decaying}, NamedScheme{"midpoint", Scheme::midpoint}})
    for (const double dt : time_steps) {
      const int steps = static_cast<int>(std::lround(turns * turn / spin / dt));
      Scene scene = flight_scene(scheme, dt, steps * dt);
      scene.analysis.gravity.setZero();
      scene.blocks[0].angular_velocity = spin;
      const BuiltScene built = build(scene);
      Stepper& stepper = *built.stepper;
      const double L = angular_momentum(stepper, 0);
      double grown = 0, lost = 0;
      for (int k = 0; k < steps; ++k) {
        run(stepper, 1);
        const Block& of = stepper.blocks().block(0);
        grown = std::max(grown, std::abs(of.moments(stepper.state()).area / of.reference_area() - 1));
        lost = std::max(lost, std::abs(angular_momentum(stepper, 0) / L - 1));
      }
      const double period = spin * stepper.state().time / stepper.state().rotation[0] - 1;
      const double law = scheme == Scheme::midpoint ? spin * dt / 2 / std::atan(spin * dt / 2) - 1 : 0;
      rows.push_back({name, fmt::format("{:g}", dt), text(period), text(law), text(grown), text(lost)});
      period_off = std::max(period_off, std::abs(period - law));
      area = std::max(area, grown);
      momentum = std::max(momentum, lost);
    }
  report.table(rows);
  report.claims({{"The period is that of its law, to 1e-5.", period_off <= 1e-5, text(period_off)},
                 {"The area does not grow: 1e-5.", area <= 1e-5, text(area)},
                 {"Angular momentum stays to 1e-6.", momentum <= 1e-6, text(momentum)}});
}

}  // namespace

void flight(Report& report) {
  report.heading("Flight");
  thrown(report);
  spun(report);
}

}  // namespace validation
