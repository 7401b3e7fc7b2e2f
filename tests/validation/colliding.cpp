/// \file Head-on and oblique collisions of two free blocks.
#include "chapters.hpp"

#include <fmt/format.h>
#include <ddacontact/picture/chart.hpp>
#include <mechanics_scenes.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace validation {

namespace {

using namespace verification;

/// The second block, 0.8 m thick and at rest, stands at x > 0; the first comes from the left with a face, or
/// turned by 45 degrees with a corner.
struct Hit {
  const char* name;
  bool corner;            ///< the first is a square turned by 45 degrees
  double side, height;    ///< of the first block and of the second, m
  double offset;          ///< of the first block's centre above the second's, m
  Vec2 speed;             ///< of the first, m/s
  double second_density;  ///< kg/m3; the first has 2500
};
constexpr double thickness = 0.8, first_density = 2500;
const std::array hits{Hit{"head on, equal", false, 0.8, 0.8, 0, {3, 0}, 2500},
                      Hit{"head on, 1 : 7", false, 0.8, 0.8, 0, {3, 0}, 17500},
                      Hit{"head on, 50 : 1", false, 0.8, 0.8, 0, {3, 0}, 50},
                      Hit{"oblique, central", true, 0.7, 1.2, 0, {3, -1.1}, 2500},
                      Hit{"oblique, grazing", true, 0.7, 1.2, 0.1, {0.8, 3.5}, 4000},
                      Hit{"off centre", true, 0.5, 1.6, 0.55, {3, 0.4}, 2000}};
constexpr std::array restitutions{0., 0.5, 1.};
constexpr std::array frictions{0., 30.};  // degrees

struct Setting {
  double time_step = 1e-3, restitution = 0, friction = 0, phase = 0.37;
  Scheme scheme = Scheme::decaying;
  ContactMethod method = ContactMethod::staged;
  double penalty = 40;  ///< of E
};

/// A rigid body: its mass per m of thickness, its inertia, and how it moves.
struct Body {
  double mass = 0, inertia = 0;
  Vec2 velocity{0, 0};
  double spin = 0;

  Vec2 at(const Vec2& r) const { return velocity + spin * Vec2(-r.y(), r.x()); }
  void push(const Vec2& impulse, const Vec2& r) {
    velocity += impulse / mass;
    spin += (r.x() * impulse.y() - r.y() * impulse.x()) / inertia;
  }
};

Body rectangle_body(double a, double b, double density) {
  const double mass = density * a * b;
  return {mass, mass * (a * a + b * b) / 12, Vec2::Zero(), 0};
}

struct Pair {
  Body first, second;
};

Pair before(const Hit& hit) {
  Pair pair{rectangle_body(hit.side, hit.side, first_density),
            rectangle_body(thickness, hit.height, hit.second_density)};
  pair.first.velocity = hit.speed;
  return pair;
}

/// Rigid bodies by impulses at one point, with Poisson's restitution: compression until nothing approaches,
/// with friction that sticks or slides; then e times the normal impulse once more, with friction again. Flat
/// faces meet as two such points do, without turning. P > 0 pushes the first block back.
Pair rigid_impact(const Hit& hit, const Setting& setting) {
  Pair pair = before(hit);
  const double reach = hit.corner ? hit.side / std::sqrt(2) : hit.side / 2,
               mu = std::tan(radians(setting.friction));
  const Vec2 r1(reach, 0), r2(-thickness / 2, hit.offset);
  const auto slip = [&] {
    return Vec2(pair.second.at(r2) - pair.first.at(r1));
  };  // of the second past the first
  const auto push = [&](const Vec2& impulse) {
    pair.first.push(-impulse, r1);
    pair.second.push(impulse, r2);
  };
  Mat2 W;  // what impulses make of that
  for (int k = 0; k < 2; ++k) {
    const Pair kept = pair;
    const Vec2 was = slip();
    push(Vec2::Unit(k));
    W.col(k) = slip() - was;
    pair = kept;
  }
  if (!hit.corner) {
    const double P = -slip().x() * (1 + setting.restitution) / (1 / pair.first.mass + 1 / pair.second.mass);
    pair.first.velocity.x() -= P / pair.first.mass;
    pair.second.velocity.x() += P / pair.second.mass;
    return pair;
  }
  Vec2 P = W.inverse() * -slip();
  if (std::abs(P.y()) > mu * P.x()) {
    const double toward = P.y() > 0 ? mu : -mu;
    P.x() = -slip().x() / (W(0, 0) + toward * W(0, 1));
    P.y() = toward * P.x();
  }
  push(P);
  const double given = setting.restitution * P.x();
  push({given, 0});
  push({0, std::clamp(-slip().y() / W(1, 1), -mu * given, mu * given)});
  return pair;
}

/// The blocks meet in the third step, after the given part of it.
Scene hit_scene(const Hit& hit, const Setting& setting) {
  Scene scene = rock_scene(setting.time_step, 1);
  scene.analysis.gravity.setZero();
  scene.analysis.scheme = setting.scheme;
  scene.materials = {{"first", first_density, 35e9, 0.3}, {"second", hit.second_density, 35e9, 0.3}};
  scene.joints[0].friction_angle = setting.friction;
  scene.joints[0].restitution = setting.restitution;
  scene.contact.normal_stiffness = setting.penalty * 35e9;
  scene.contact.tangential_stiffness = scene.contact.normal_stiffness / 2.5;
  if (setting.method == ContactMethod::classic) {
    scene.contact.method = ContactMethod::classic;
    scene.contact.penetration_tolerance = 0;
    scene.joints[0].restitution = 0;
  }
  const double time = (2 + setting.phase) * setting.time_step;
  Points first = rectangle(-hit.side / 2, -hit.side / 2, hit.side, hit.side);
  if (hit.corner) first = turned(first, turn / 8);
  const double reach = hit.corner ? hit.side / std::sqrt(2) : hit.side / 2;
  first.colwise() += Vec2(-reach, hit.offset) - time * hit.speed;
  scene.blocks = {block(first), block(rectangle(0, -hit.height / 2, thickness, hit.height))};
  scene.blocks[0].velocity = hit.speed;
  scene.blocks[1].material = 1;
  return scene;
}

/// What a collision made, and its errors.
struct Collided {
  double velocity = 0;             ///< error of velocities and of edges' speeds by spin, over the approach
  double linear = 0, angular = 0;  ///< largest change over sum |m v|, per 1 m
  double energy_up = -1, beyond_cone = 0;  ///< relative; |P_t|/P_n less tan(phi)
  double restitution = 0;                  ///< parting by approaching normal speed of the places that met
};

Collided collide(const Hit& hit, const Setting& setting) {
  const BuiltScene built = build(hit_scene(hit, setting));
  Stepper& stepper = *built.stepper;
  const Momenta start = momenta(stepper);
  const double energy = mechanical_energy(stepper), dt = setting.time_step;
  Collided result;
  const auto look = [&] {
    const Momenta now = momenta(stepper);
    result.linear = std::max(result.linear, (now.linear - start.linear).norm() / start.sum_of_moduli);
    result.angular = std::max(result.angular, std::abs(now.angular - start.angular) / start.sum_of_moduli);
    result.energy_up = std::max(result.energy_up, mechanical_energy(stepper) / energy - 1);
  };
  // Springs take their time.
  const int more = setting.method == ContactMethod::classic ? static_cast<int>(std::ceil(2e-3 / dt)) : 0;
  for (int k = 0; k < 4 + more; ++k) {
    run(stepper, 1);
    look();
  }
  const Pair rigid = rigid_impact(hit, setting);
  const double approach = hit.speed.x();
  const std::array bodies{rigid.first, rigid.second};
  const std::array sizes{hit.side, hit.height};
  for (int b = 0; b < 2; ++b) {
    const std::size_t k = static_cast<std::size_t>(b);
    const double turning = sizes[k] / 2 * std::abs(angular_velocity(stepper, b) - bodies[k].spin);
    result.velocity = std::max(
        {result.velocity, (velocity(stepper, b) - bodies[k].velocity).norm() / approach, turning / approach});
  }
  const Vec2 impulse = rigid.first.mass * (hit.speed - velocity(stepper, 0));
  result.beyond_cone = std::abs(impulse.y()) / impulse.x() - std::tan(radians(setting.friction));
  result.restitution = (velocity(stepper, 1).x() - velocity(stepper, 0).x()) / approach;
  return result;
}

void over_steps(Report& report) {
  const std::vector<double> time_steps{2e-2, 5e-3, 1e-3, 1e-4, 1e-5};
  report.paragraph(
      "Largest error of the velocities two steps after the hit, the speed of edges by spin included, over "
      "the speed of approach. It is the largest over e = 0, 1/2, 1, friction of 0 and 30°, and 3 phases of "
      "the hit within its step:");
  std::vector<std::vector<std::string>> rows{{"collision"}};
  for (const double dt : time_steps) rows[0].push_back(fmt::format("Δt = {:g} s", dt));
  rows[0].insert(rows[0].end(), {"momentum", "angular", "energy up", "beyond the cone"});
  Collided worst;
  double coarse = 0, fine = 0;
  worst.beyond_cone = -1;
  for (const Hit& hit : hits) {
    rows.push_back({hit.name});
    Collided of_hit;
    of_hit.beyond_cone = -1;
    for (const double dt : time_steps) {
      double largest = 0;
      for (const double e : restitutions)
        for (const double friction : frictions)
          for (const double phase : {0.03, 0.5, 0.98}) {
            const Collided c =
                collide(hit, {.time_step = dt, .restitution = e, .friction = friction, .phase = phase});
            largest = std::max(largest, c.velocity);
            of_hit.linear = std::max(of_hit.linear, c.linear);
            of_hit.angular = std::max(of_hit.angular, c.angular);
            of_hit.energy_up = std::max(of_hit.energy_up, c.energy_up);
            of_hit.beyond_cone = std::max(of_hit.beyond_cone, c.beyond_cone);
          }
      rows.back().push_back(text(largest));
      fine = std::max(fine, largest);
      if (dt >= 1e-4) coarse = std::max(coarse, largest);
    }
    rows.back().insert(rows.back().end(), {text(of_hit.linear), text(of_hit.angular), text(of_hit.energy_up),
                                           text(of_hit.beyond_cone)});
    worst.linear = std::max(worst.linear, of_hit.linear);
    worst.angular = std::max(worst.angular, of_hit.angular);
    worst.energy_up = std::max(worst.energy_up, of_hit.energy_up);
    worst.beyond_cone = std::max(worst.beyond_cone, of_hit.beyond_cone);
  }
  report.table(rows);
  report.paragraph(
      "With steps of 1e-5 s the block that was hit is left within the tolerance of penetration (1e-6 of its "
      "size), and its contact "
      "acts once more. Impulses are taken by the face as it stood when hit.");
  report.claims(
      {{"Velocities of rigid impact to 1e-6 at steps of 0.1 ms and more, to 1e-4 at all: "
        "restitution, friction and spin as asked.",
        coarse <= 1e-6 && fine <= 1e-4, fmt::format("{}, {}", text(coarse), text(fine))},
       {"Momentum stays to 1e-12 of the sum of the blocks' own.", worst.linear <= 1e-12, text(worst.linear)},
       {"Angular momentum stays to 1e-6.", worst.angular <= 1e-6, text(worst.angular)},
       {"Energy is never up by 1e-12.", worst.energy_up <= 1e-12, text(worst.energy_up)},
       {"P_T/P_N exceeds tan φ by no more than 1e-4.", worst.beyond_cone <= 1e-4, text(worst.beyond_cone)}});
}

const std::vector<double> chart_steps{1e-5, 3e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 2e-2};

/// Other methods than the default, that have no restitution to ask for.
struct Peer {
  std::string name;
  Scheme scheme;
  double penalty;
};
const std::array peers{Peer{"classic, dda, p = E", Scheme::dda, 1},
                       Peer{"classic, dda, p = 40 E", Scheme::dda, 40},
                       Peer{"classic, dda, p = 1000 E", Scheme::dda, 1000},
                       Peer{"classic, newmark, p = 40 E", Scheme::newmark, 40},
                       Peer{"classic, backward_euler, p = 40 E", Scheme::backward_euler, 40}};

Setting of(const Peer& peer, double dt) {
  return {.time_step = dt, .scheme = peer.scheme, .method = ContactMethod::classic, .penalty = peer.penalty};
}

void by_springs(Report& report) {
  report.paragraph(
      "### Restitution of the original method\n\n`classic` blocks bounce off their springs, and off their "
      "own elasticity. What the scheme makes of that within the step is their restitution, an accident of p "
      "and Δt (head on, equal squares). The default's is what is requested. With steps longer than the hit "
      "Newmark (1/4, 1/2) throws the blocks apart with more energy than they had.");
  Chart chart{.x_symbol = {"Δt", "", ""},
              .y_symbol = {"e", "", ""},
              .x_unit = "s",
              .y_unit = "",
              .series = {},
              .x_logarithmic = true};
  std::vector<std::vector<std::string>> rows{{"Δt, s"}};
  for (const double dt : chart_steps) rows.push_back({fmt::format("{:g}", dt)});
  const auto add = [&](const std::string& called, const auto& setting_of) {
    Series series{called, {}, {}};
    series.dots = true;
    rows[0].push_back(called);
    for (std::size_t k = 0; k < chart_steps.size(); ++k) {
      double e = std::numeric_limits<double>::quiet_NaN();
      try {
        e = collide(hits[0], setting_of(chart_steps[k])).restitution;
      } catch (const Error&) {  // stopped
      }
      rows[k + 1].push_back(std::isfinite(e) ? fmt::format("{:.4f}", std::abs(e) < 1e-6 ? 0 : e) : "stopped");
      series.x.push_back(chart_steps[k]);
      series.y.push_back(e);
    }
    chart.series.push_back(series);
  };
  for (const double e : restitutions)
    add(fmt::format("e = {:g} asked", e),
        [e](double dt) { return Setting{.time_step = dt, .restitution = e}; });
  for (const Peer& peer : peers) add(peer.name, [&peer](double dt) { return of(peer, dt); });
  report.table(rows);
  report.picture(
      "dda_colliding_restitution",
      draw({chart}, {.title = "Two equal squares, head on", .width = 760, .plot_height = 280}),
      "Restitution against the time step: the default method asked for 0, 1/2 and 1, and `classic`.");
}

void error_against_time(Report& report) {
  report.paragraph(
      "### Error against run time\n\nThe off-centre hit, elastic and without friction (e = 1; of `classic` "
      "nothing can be asked). The chart has the error of the velocities after it over the speed of approach, "
      "against the run time of a collision (2 ms or 4 steps).");
  Chart chart{.x_symbol = {"run time", "", ""},
              .y_symbol = {"error of the velocity", "", ""},
              .x_unit = "ms",
              .y_unit = "",
              .series = {},
              .x_logarithmic = true,
              .y_logarithmic = true};
  std::vector<std::vector<std::string>> rows{{"Δt, s"}};
  for (const double dt : chart_steps) rows.push_back({fmt::format("{:g}", dt)});
  const auto add = [&](const std::string& called, const auto& setting_of) {
    Series series{called, {}, {}};
    series.dots = true;
    rows[0].push_back(called);
    for (std::size_t k = 0; k < chart_steps.size(); ++k) {
      double error = std::numeric_limits<double>::quiet_NaN();
      Setting setting = setting_of(chart_steps[k]);
      setting.restitution = 1;
      const double seconds = seconds_of([&] {
        try {
          error = collide(hits.back(), setting).velocity;
        } catch (const Error&) {  // stopped
        }
      });
      rows[k + 1].push_back(std::isfinite(error) ? text(error) : "stopped");
      series.x.push_back(1e3 * seconds);
      series.y.push_back(error);
    }
    chart.series.push_back(series);
  };
  for (const Scheme scheme : {Scheme::decaying, Scheme::midpoint})
    add(scheme == Scheme::decaying ? "decaying" : "midpoint",
        [scheme](double dt) { return Setting{.time_step = dt, .scheme = scheme}; });
  for (const Peer& peer : peers)
    if (peer.penalty == 40) add(peer.name, [&peer](double dt) { return of(peer, dt); });
  report.table(rows);
  report.picture("dda_colliding_cost",
                 draw({chart}, {.title = "An off-centre hit", .width = 760, .plot_height = 280}),
                 "Error of the velocities after an off-centre hit against run time, Δt from 1e-5 to 2e-2 s.");
}

}  // namespace

void colliding(Report& report) {
  report.heading("Collisions");
  report.paragraph(
      "Two free blocks of 35 GPa collide without gravity. A square meets a rectangle at rest, face to face, "
      "or turned by 45° with a corner on the middle of a face or off it, which makes them spin. Rigid bodies "
      "by impulses: compression until nothing approaches, with friction that sticks or slides, |P_T| ≤ P_N "
      "tan φ; then e P_N once more, with friction again (Poisson).");
  over_steps(report);
  by_springs(report);
  error_against_time(report);
}

}  // namespace validation
