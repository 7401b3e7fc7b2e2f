/// \file A rocking block.
#include "chapters.hpp"

#include <fmt/format.h>
#include <ddacontact/output/frame.hpp>
#include <ddacontact/picture/chart.hpp>
#include <ddacontact/picture/picture.hpp>
#include <mechanics_scenes.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace validation {

namespace {

using namespace verification;

/// A rectangle that stands on a plane, tilted about its lower right corner, and is let go.
struct Rocker {
  double half_diagonal;  ///< R, m
  double slenderness;    ///< the angle alpha of the diagonal with the vertical, radians
  double tilt;           ///< at the start, of alpha

  double width() const { return 2 * half_diagonal * std::sin(slenderness); }
  double height() const { return 2 * half_diagonal * std::cos(slenderness); }
  double start() const { return tilt * slenderness; }
  double p2() const { return 3 * gravity / (4 * half_diagonal); }
  double housner_period() const { return 4 / std::sqrt(p2()) * std::acosh(1 / (1 - tilt)); }
  /// Of kinetic energy, what an impact leaves.
  double housner_ratio() const { return std::pow(1 - 1.5 * std::pow(std::sin(slenderness), 2), 2); }
  /// The amplitude after an impact that leaves `ratio` of the energy of falling from `amplitude`.
  double next_amplitude(double amplitude, double ratio) const {
    const double level = std::cos(slenderness);
    return slenderness - std::acos(level + ratio * (std::cos(slenderness - amplitude) - level));
  }
  /// What an impact between two amplitudes left of the energy.
  double ratio(double before, double after) const {
    const double level = std::cos(slenderness);
    return (std::cos(slenderness - after) - level) / (std::cos(slenderness - before) - level);
  }
};

/// The time to fall from rest at an amplitude: phi'' = p2 sin(phi) from alpha - amplitude to alpha, where
/// phi = phi0 + s2 takes the root out of the integrand; Gauss's three points on each of 200 parts.
double falling_time(const Rocker& rocker, double amplitude) {
  constexpr int parts = 200;
  const double phi0 = rocker.slenderness - amplitude, end = std::sqrt(amplitude), h = end / parts;
  const double node = std::sqrt(0.6);
  double sum = 0;
  for (int k = 0; k < parts; ++k)
    for (const auto& [x, weight] :
         {std::pair{-node, 5. / 18}, std::pair{0., 8. / 18}, std::pair{node, 5. / 18}}) {
      const double s = (k + 0.5 + x / 2) * h;
      sum += weight * h * s / std::sqrt(std::sin(phi0 + s * s / 2) * std::sin(s * s / 2));
    }
  return sum / std::sqrt(rocker.p2());
}

struct Setting {
  double time_step = 1e-3;
  Scheme scheme = Scheme::decaying;
  double young = 35e9, penalty = 40;  ///< Pa, of E
  ContactMethod method = ContactMethod::staged;
};

Scene rocking_scene(const Rocker& rocker, const Setting& setting) {
  Scene scene = rock_scene(setting.time_step, 1, setting.young);
  scene.analysis.scheme = setting.scheme;
  scene.joints[0].friction_angle = 60;
  scene.joints[0].restitution = 0;
  scene.contact.normal_stiffness = setting.penalty * setting.young;
  scene.contact.tangential_stiffness = scene.contact.normal_stiffness / 2.5;
  if (setting.method == ContactMethod::classic) {
    scene.contact.method = ContactMethod::classic;
    scene.contact.penetration_tolerance = 0;
  }
  const double b = rocker.width(), h = rocker.height();
  scene.blocks = {block(rectangle(-3 * h, -0.3 * h, 6 * h, 0.3 * h), true),
                  block(turned(rectangle(-b, 0, b, h), -rocker.start()))};
  return scene;
}

/// What a rocking block does: when it stands upright, how far it tilts after.
struct Rocked {
  std::vector<double> impacts, amplitudes;
  std::vector<double> time, tilt;
};

Rocked rock(const Rocker& rocker, const Setting& setting, int impacts) {
  const BuiltScene built = build(rocking_scene(rocker, setting));
  Stepper& stepper = *built.stepper;
  const double dt = setting.time_step;
  Rocked rocked;
  rocked.time = {0};
  rocked.tilt = {rocker.start()};
  double speed = 0, earlier_speed = 0;
  const double patience = 3 * falling_time(rocker, rocker.start()) * (impacts + 1);
  while (static_cast<int>(rocked.impacts.size()) < impacts || speed * rocked.tilt.back() > 0) {
    run(stepper, 1);
    const double t = stepper.state().time, tilt = rocker.start() - stepper.state().rotation[1],
                 now = -angular_velocity(stepper, 1), before = rocked.tilt.back();
    if (tilt * before < 0 || (tilt == 0 && before != 0)) {
      // Where the fall before this step goes on to.
      const double growth = (speed - earlier_speed) / dt;
      const double time =
          2 * before / (-speed - std::copysign(std::sqrt(speed * speed - 2 * growth * before), speed));
      rocked.impacts.push_back(t - dt + time);
    } else if (speed * before > 0 && now * before <= 0 && !rocked.impacts.empty()) {
      const double time = dt * speed / (speed - now);
      rocked.amplitudes.push_back(std::abs(before + speed * time / 2));
    }
    rocked.time.push_back(t);
    rocked.tilt.push_back(tilt);
    earlier_speed = speed;
    speed = now;
    if (t > patience) break;  // it has come to rest
  }
  return rocked;
}

/// The rigid block's tilt over time, with Housner's impacts, until `end`.
Series rigid_tilt(const Rocker& rocker, double end) {
  constexpr double dt = 1e-4;
  Series series{"rigid, Housner's impacts", {0}, {rocker.start()}};
  double phi = rocker.slenderness - rocker.start(), speed = 0, side = 1;
  for (int k = 1; k * dt <= end; ++k) {
    // Velocity Verlet.
    speed += dt / 2 * rocker.p2() * std::sin(phi);
    phi += dt * speed;
    speed += dt / 2 * rocker.p2() * std::sin(phi);
    if (phi > rocker.slenderness) {  // upright: over to the other corner
      phi = 2 * rocker.slenderness - phi;
      speed *= -std::sqrt(rocker.housner_ratio());
      side = -side;
    }
    if (k % 50 == 0) {
      series.x.push_back(k * dt);
      series.y.push_back(side * (rocker.slenderness - phi));
    }
  }
  return series;
}

std::vector<Rocker> rockers() {
  std::vector<Rocker> all;
  for (const auto& [R, degrees] :
       {std::pair{0.4, 8.}, std::pair{1.1, 15.}, std::pair{2.5, 22.}, std::pair{7., 30.}})
    for (const double tilt : {0.25, 0.6, 0.9}) all.push_back({R, radians(degrees), tilt});
  return all;
}

void periods(Report& report) {
  report.paragraph("### The period");
  report.paragraph(
      "T is four times the time from the release until the block stands upright. The rigid block's is the "
      "integral of "
      "φ'' = p² sin φ, φ = α − θ, to 1e-10; Housner's linearizes the sine and is off as the last column "
      "says. "
      "Δt = 2 ms. Spread: largest relative change of T with E = 3.5 and 350 GPa, and with penalties of E and "
      "1000 E.");
  std::vector<std::vector<std::string>> rows{
      {"R, m", "α", "θ₀/α", "T rigid, s", "T computed, s", "error", "spread", "T Housner, s", "its error"}};
  double worst = 0, widest = 0;
  for (const Rocker& rocker : rockers()) {
    const double rigid = 4 * falling_time(rocker, rocker.start());
    const double computed = 4 * rock(rocker, {.time_step = 2e-3}, 1).impacts.at(0);
    double spread = 0;
    for (const Setting& other :
         {Setting{2e-3, Scheme::decaying, 3.5e9, 40}, Setting{2e-3, Scheme::decaying, 350e9, 40},
          Setting{2e-3, Scheme::decaying, 35e9, 1}, Setting{2e-3, Scheme::decaying, 35e9, 1000}})
      spread = std::max(spread, std::abs(4 * rock(rocker, other, 1).impacts.at(0) / computed - 1));
    rows.push_back({text(rocker.half_diagonal), fmt::format("{:.0f}°", rocker.slenderness * 360 / turn),
                    text(rocker.tilt), fmt::format("{:.5f}", rigid), fmt::format("{:.5f}", computed),
                    text(std::abs(computed / rigid - 1)), text(spread),
                    fmt::format("{:.5f}", rocker.housner_period()),
                    text(rocker.housner_period() / rigid - 1)});
    worst = std::max(worst, std::abs(computed / rigid - 1));
    widest = std::max(widest, spread);
  }
  report.table(rows);
  report.claims(
      {{"The period of rocking within 1 %.", worst <= 0.01, text(worst) + " at most"},
       {"E and the penalty do not matter to it: 1e-4.", widest <= 1e-4, text(widest) + " at most"}});
}

void impacts(Report& report) {
  report.paragraph("### Impacts and amplitudes");
  report.paragraph(
      "Housner: the angular momentum about the corner that hits is kept, the other corner leaves without an "
      "impulse, and r = (1 − 3/2 sin² α)² of the energy is left. Contacts of restitution 0 that push but do "
      "not pull, and whose friction holds, make just that: stopping the corner that hits lifts the other "
      "one. Energy that the first impact leaves, by the amplitudes before and after, over Housner's r. The "
      "columns are least and most over 16 phases of the impact within its step (R = 1.1 m, θ₀ = 0.6 α). The "
      "forces of a step are those of its end, so that gravity brakes the block through the whole step of the "
      "impact, though it drove it until then. Up to 4 p² sin α Δt/ω of the energy is lost.");
  std::vector<std::vector<std::string>> rows{{"α", "r", "Δt, s", "least", "most", "4 p² sin α Δt/ω"}};
  double above = -1, beyond = 0, finest = 0;
  const std::vector<double> time_steps{8e-3, 4e-3, 2e-3, 1e-3, 5e-4};
  for (const double degrees : {8., 15., 30.})
    for (const double dt : time_steps) {
      double least = 1e300, most = 0, bound = 0;
      for (int phase = 0; phase < 16; ++phase) {
        const double alpha = radians(degrees);
        Rocker rocker{1.1, alpha, 0.6};
        const double fall = falling_time(rocker, rocker.start());
        rocker.half_diagonal *= std::pow(1 + phase / 16. * dt / fall, 2);  // falls a part of a step longer
        const double after = rock(rocker, {.time_step = dt}, 1).amplitudes.at(0);
        const double left = rocker.ratio(rocker.start(), after) / rocker.housner_ratio();
        least = std::min(least, left);
        most = std::max(most, left);
        const double speed =
            std::sqrt(2 * rocker.p2() * (std::cos(alpha - rocker.start()) - std::cos(alpha)));
        bound = 4 * rocker.p2() * std::sin(alpha) * dt / speed;
      }
      rows.push_back({fmt::format("{:.0f}°", degrees),
                      fmt::format("{:.4f}", Rocker{1.1, radians(degrees), 0.6}.housner_ratio()), text(dt),
                      fmt::format("{:.4f}", least), fmt::format("{:.4f}", most), text(bound)});
      above = std::max(above, most - 1);
      beyond = std::max(beyond, (1 - least) / bound);
      if (dt == time_steps.back()) finest = std::max({finest, std::abs(least - 1), std::abs(most - 1)});
    }
  report.table(rows);
  report.claims({{"An impact never leaves more than Housner's.", above <= 1e-3,
                  fmt::format("{} beyond it at most", text(above))},
                 {"It leaves less by the last column at most (1.2 times that).", beyond <= 1.2,
                  fmt::format("{:.2f} times at most", beyond)},
                 {"At 0.5 ms it is Housner's to 1 %.", finest <= 0.01, text(finest)}});
}

/// Tilt over time, and when the block stands upright, against a rigid block with Housner's impacts.
void swings(Report& report) {
  const Rocker rocker{1.8, radians(18), 0.7};
  constexpr int n_impacts = 5;
  report.paragraph(
      fmt::format("One block over {} impacts (R = {} m, α = 18°, θ₀ = {} α): error of the times at which it "
                  "stands upright against the rigid block with Housner's r. Then the error of the amplitude "
                  "after the first three impacts.",
                  n_impacts, rocker.half_diagonal, rocker.tilt));
  Chart chart{
      .x_symbol = {"t", "", ""}, .y_symbol = {"θ/α", "", ""}, .x_unit = "s", .y_unit = "", .series = {}};
  std::vector<std::vector<std::string>> rows{{"Δt, s"}};
  for (int k = 1; k <= n_impacts; ++k) rows[0].push_back(fmt::format("time {}", k));
  for (int k = 1; k <= 3; ++k) rows[0].push_back(fmt::format("amplitude {}", k));
  std::vector<double> rigid;
  double amplitude = rocker.start(), time = falling_time(rocker, amplitude);
  std::vector<double> amplitudes;
  for (int k = 0; k < n_impacts; ++k) {
    rigid.push_back(time);
    amplitude = rocker.next_amplitude(amplitude, rocker.housner_ratio());
    amplitudes.push_back(amplitude);
    time += 2 * falling_time(rocker, amplitude);
  }
  const Series reference = rigid_tilt(rocker, rigid.back());
  chart.series.push_back(reference);
  double worst = 0;
  for (const double dt : {8e-3, 4e-3, 2e-3, 1e-3, 5e-4, 1e-4}) {
    const Rocked rocked = rock(rocker, {.time_step = dt}, n_impacts);
    rows.push_back({fmt::format("{:g}", dt)});
    for (int k = 0; k < n_impacts; ++k) {
      const double error =
          rocked.impacts.at(static_cast<std::size_t>(k)) / rigid[static_cast<std::size_t>(k)] - 1;
      rows.back().push_back(text(error));
      if (dt <= 5e-4) worst = std::max(worst, std::abs(error));
    }
    for (std::size_t k = 0; k < 3; ++k)
      rows.back().push_back(text(rocked.amplitudes.at(k) / amplitudes[k] - 1));
    if (dt == 8e-3 || dt == 1e-3) {
      Series computed{fmt::format("Δt = {:g} ms", 1e3 * dt), rocked.time, rocked.tilt, false};
      chart.series.push_back(computed);
    }
  }
  for (Series& series : chart.series)
    for (double& tilt : series.y) tilt /= rocker.slenderness;
  report.table(rows);
  report.picture("dda_rocking_tilt", draw({chart}, {.title = "A rocking block", .plot_height = 260}),
                 "Tilt over time: rigid with Housner's impacts, and computed.");
  report.claims(
      {{"Five half periods, the impacts between them included, within 1 % at steps of 0.5 ms and less.",
        worst <= 0.01, text(worst) + " at most"}});
}

void error_against_time(Report& report) {
  const Rocker rocker{1.8, radians(18), 0.7};
  report.paragraph(
      "### Error against run time\n\nError of the period over the length of the step, by scheme, and with "
      "the springs of the "
      "original method (`classic`, p = 40 E, scheme `dda`):");
  struct Way {
    const char* name;
    Scheme scheme;
    ContactMethod method;
  };
  std::vector<Way> ways;
  for (const NamedScheme& scheme : schemes)
    ways.push_back({scheme.name, scheme.scheme, ContactMethod::staged});
  ways.push_back({"classic, dda", Scheme::dda, ContactMethod::classic});
  const std::vector<double> time_steps{2e-2, 1e-2, 5e-3, 2e-3, 1e-3, 5e-4};
  Chart chart{.x_symbol = {"run time", "", ""},
              .y_symbol = {"error of the period", "", ""},
              .x_unit = "ms",
              .y_unit = "",
              .series = {},
              .x_logarithmic = true,
              .y_logarithmic = true};
  std::vector<std::vector<std::string>> rows{{"Δt, s"}};
  for (const double dt : time_steps) rows.push_back({fmt::format("{:g}", dt)});
  const double rigid = falling_time(rocker, rocker.start());
  double coarse = 0, fine = 0;
  for (const Way& way : ways) {
    rows[0].push_back(way.name);
    Series series{way.name, {}, {}};
    series.dots = true;
    for (std::size_t k = 0; k < time_steps.size(); ++k) {
      double error = std::numeric_limits<double>::quiet_NaN();
      const double seconds = seconds_of([&] {
        try {
          const Setting setting{time_steps[k], way.scheme, 35e9, 40, way.method};
          error = std::abs(rock(rocker, setting, 1).impacts.at(0) / rigid - 1);
        } catch (const std::exception&) {  // stopped, or never upright: no period to show
        }
      });
      if (way.scheme == Scheme::decaying && k == 0) coarse = error;
      if (way.scheme == Scheme::decaying && k == 2) fine = error;
      rows[k + 1].push_back(std::isfinite(error) ? text(error) : "stopped");
      series.x.push_back(1e3 * seconds);
      series.y.push_back(error);
    }
    chart.series.push_back(series);
  }
  report.table(rows);
  report.paragraph(
      "Below 1e-5 the elastic block shows: released suddenly it vibrates, about 1e-6 here, and the "
      "conserving schemes keep "
      "that up. Newmark (1/4, 1/2) is not for stiff contacts: what alternates from step to step stays.");
  report.picture("dda_rocking_cost",
                 draw({chart}, {.title = "Period of a rocking block", .plot_height = 260}),
                 "Error of the period against run time, by scheme.");
  report.claims({{"The period converges at the decaying scheme's order, 2 (1.8 or more from 20 to 5 ms).",
                  std::log2(coarse / fine) / 2 >= 1.8, fmt::format("{:.2f}", std::log2(coarse / fine) / 2)}});
}

}  // namespace

void rocking(Report& report) {
  report.heading("Rocking");
  report.paragraph(
      "A rectangle on a plane, tilted by θ₀ about its lower right corner and let go: it falls back, and "
      "rocks from corner to "
      "corner. With R half its diagonal, at the angle α to its long side, a rigid block has (Housner 1963) "
      "T = (4/p) acosh(1/(1 − θ₀/α)), p² = 3g/4R. E = 35 GPa, friction 60°, so that it does not slide.");
  periods(report);
  impacts(report);
  swings(report);
  error_against_time(report);
}

}  // namespace validation
