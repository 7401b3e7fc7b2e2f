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
  bool corner;           ///< the first is a square turned by 45 degrees
  double side, height;   ///< of the first block and of the second, m
  double offset;         ///< of the first block's centre above the second's, m
  Vec2 speed;            ///< of the first, m/s
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

/// Rigid bodies by impulses at one point, with Poisson's restitution: compression until nothing approaches, with
/// friction that sticks or slides; then e times the normal impulse once more, with friction again. Flat faces
/// meet as two such points do, without turning. P > 0 pushes the first block back.
Pair rigid_impact(const Hit& hit, const Setting& setting) {
  Pair pair = before(hit);
  const double reach = hit.corner ? hit.side / std::sqrt(2) : hit.side / 2, mu = std::tan(radians(setting.friction));
  const Vec2 r1(reach, 0), r2(-thickness / 2, hit.offset);
  const auto slip = [&] { return Vec2(pair.second.at(r2) - pair.first.at(r1)); };  // of the second past the first
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
  double velocity = 0;                    ///< error of velocities and of edges' speeds by spin, over the approach
  double place = 0;                       ///< error of places two steps after the hit, over the approach times dt
  double linear = 0, angular = 0;         ///< largest change over sum |m v|, per 1 m
  double energy_up = -1, beyond_cone = 0;  ///< relative; |P_t|/P_n less tan(phi)
  double restitution = 0;                 ///< parting by approaching normal speed of the places that met
};

Collided collide(const Hit& hit, const Setting& setting) {
  const BuiltScene built = build(hit_scene(hit, setting));
  Stepper& stepper = *built.stepper;
  const Momenta start = momenta(stepper);
  const double energy = mechanical_energy(stepper), dt = setting.time_step, time = (2 + setting.phase) * dt;
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
  const Pair rigid = rigid_impact(hit, setting), were = before(hit);
  const double approach = hit.speed.x();
  const std::array bodies{rigid.first, rigid.second}, starts{were.first, were.second};
  const std::array sizes{hit.side, hit.height};
  for (int b = 0; b < 2; ++b) {
    const std::size_t k = static_cast<std::size_t>(b);
    const double turning = sizes[k] / 2 * std::abs(angular_velocity(stepper, b) - bodies[k].spin);
    result.velocity = std::max({result.velocity, (velocity(stepper, b) - bodies[k].velocity).norm() / approach,
                                turning / approach});
    const Vec2 place = time * starts[k].velocity + (stepper.state().time - time) * bodies[k].velocity;
    result.place = std::max(result.place, (travel(stepper, b) - place).norm() / (approach * dt));
  }
  const Vec2 impulse = rigid.first.mass * (hit.speed - velocity(stepper, 0));
  result.beyond_cone = std::abs(impulse.y()) / impulse.x() - std::tan(radians(setting.friction));
  result.restitution = (velocity(stepper, 1).x() - velocity(stepper, 0).x()) / approach;
  return result;
}

void over_steps(Report& report) {
  const std::vector<double> time_steps{2e-2, 5e-3, 1e-3, 1e-4, 1e-5};
  report.paragraph(
      "Largest error of the velocities two steps after the hit, the speed of edges by spin included, over the speed of "
      "approach; over e = 0, 1/2, 1, friction of 0 and 30°, and 3 phases of the hit within its step:");
  std::vector<std::vector<std::string>> rows{{"collision"}};
  for (const double dt : time_steps) rows[0].push_back(fmt::format("Δt = {:g} s", dt));
  rows[0].insert(rows[0].end(), {"momentum", "angular", "energy up", "beyond the cone"});
  Collided worst;
  double central = 0, eccentric = 0, fine = 0;
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
            const Collided c = collide(hit, {.time_step = dt, .restitution = e, .friction = friction, .phase = phase});
            largest = std::max(largest, c.velocity);
            of_hit.linear = std::max(of_hit.linear, c.linear);
            of_hit.angular = std::max(of_hit.angular, c.angular);
            of_hit.energy_up = std::max(of_hit.energy_up, c.energy_up);
            of_hit.beyond_cone = std::max(of_hit.beyond_cone, c.beyond_cone);
          }
      rows.back().push_back(text(largest));
      double& of_kind = hit.corner ? eccentric : central;
      of_kind = std::max(of_kind, largest);
      if (dt <= 1e-4) fine = std::max(fine, largest);
    }
    rows.back().insert(rows.back().end(),
                       {text(of_hit.linear), text(of_hit.angular), text(of_hit.energy_up), text(of_hit.beyond_cone)});
    worst.linear = std::max(worst.linear, of_hit.linear);
    worst.angular = std::max(worst.angular, of_hit.angular);
    worst.energy_up = std::max(worst.energy_up, of_hit.energy_up);
    worst.beyond_cone = std::max(worst.beyond_cone, of_hit.beyond_cone);
  }
  report.table(rows);
  fmt::print("{} {} {}\n", central, eccentric, fine);
}

}  // namespace

void colliding(Report& report) {
  report.heading("Collisions");
  over_steps(report);
  for (double p : {1., 40., 1000.}) for (Scheme s : {Scheme::dda, Scheme::newmark, Scheme::backward_euler}) {
    fmt::print("p {} s {}:", p, int(s));
    for (double dt : {1e-5,1e-4,1e-3,5e-3,2e-2}) {
      try { const Collided c = collide(hits[0], {.time_step=dt,.restitution=1,.scheme=s,.method=ContactMethod::classic,.penalty=p}); fmt::print(" {:.4f}", c.restitution);} catch (const std::exception& e) { fmt::print(" stop"); }
    }
    fmt::print("\n");
  }
}

}  // namespace validation
