#include "mechanics_chapters.hpp"
#include "mechanics_scenes.hpp"

#include <fmt/format.h>
#include <ddacontact/block/corotational_shape.hpp>
#include <ddacontact/picture/chart.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace verification {

namespace {

constexpr int steps_a_turn = 100, turns = 1000;
constexpr double time_step = 1. / steps_a_turn;  // one turn a second

Scene spin_scene(BlockModel model, Scheme scheme, Kinematics kinematics, int steps, double dt = time_step,
                 double young = 35e9) {
  Scene scene = rock_scene(dt, steps, young);
  scene.analysis.gravity.setZero();
  scene.analysis.scheme = scheme;
  scene.analysis.kinematics = kinematics;
  if (kinematics == Kinematics::incremental) {
    scene.analysis.preset = Preset::paper;
    scene.analysis.gradient_correction = GradientCorrection::off;
    scene.contact.method = ContactMethod::classic;
    scene.contact.penetration_tolerance = 0;
  }
  scene.blocks = {block(pentagon())};
  scene.blocks[0].model = model;
  scene.blocks[0].velocity = {3, 1};
  scene.blocks[0].angular_velocity = turn;
  return scene;
}

/// Area over that at rest, less 1, of the block that turns steadily: K u = w^2 M (X + u).
double steady_stretch(const Block& block, BlockModel model, double angular_velocity) {
  const Points outline = block.reference().colwise() - polyfem::area_moments(block.reference()).centroid;
  const CorotationalShape shape = model == BlockModel::affine
                                      ? affine_shape(block.material(), outline)
                                      : polygon_shape(block.material(), outline, polyfem::wachspress,
                                                      choose_integration(outline, GradientCorrection::on));
  const Index m = shape.nodes.cols();
  const ShapeCell& cell = shape.cells.front();
  MatrixXd A = cell.elastic.stiffness();
  for (Index a = 0; a < m; ++a)
    for (Index b = 0; b < m; ++b)
      A.block<2, 2>(2 * a, 2 * b) -= angular_velocity * angular_velocity * cell.mass(a, b) * Mat2::Identity();
  const Points centrifugal = angular_velocity * angular_velocity * shape.nodes * cell.mass;
  // Translations carry no force here; they do not change the area either.
  const VectorXd u = A.fullPivLu().solve(VectorXd(centrifugal.reshaped()));
  Points stretched = shape.nodes + u.reshaped(2, m);
  if (shape.points.size() > 0) stretched = (stretched * shape.points.transpose()).eval();
  return polyfem::area_moments(stretched).area / polyfem::area_moments(outline).area - 1;
}

/// What 1000 turns leave.
struct Spun {
  double momentum = 0, angular_momentum = 0;  ///< largest relative changes
  double energy_up = -1;                      ///< largest relative change, with its sign
  double energy_end = 0;
  double stretch = 0;     ///< steady, by the closed form
  double area_error = 0;  ///< of the mean of the last turn, beyond the stretch
  double swing = 0,
         swing_growth =
             0;  ///< half the range of area in the last turn, and that over the second turn's less 1
  double seconds = 0;
};

/// Least and largest, and mean, area of one turn over that at rest, less 1.
struct AreaOfATurn {
  double least = 1e300, most = -1e300, sum = 0;
  void take(double area) {
    least = std::min(least, area);
    most = std::max(most, area);
    sum += area;
  }
};

Spun spin(BlockModel model, Scheme scheme) {
  Spun spun;
  const BuiltScene built = build(spin_scene(model, scheme, Kinematics::corotational, turns * steps_a_turn));
  Stepper& stepper = *built.stepper;
  const Block& of = stepper.blocks().block(0);
  const Vec2 v0 = velocity(stepper, 0);
  const double L0 = angular_momentum(stepper, 0), E0 = mechanical_energy(stepper);
  AreaOfATurn early, late;
  spun.seconds = seconds_of([&] {
    for (int k = 0; k < turns * steps_a_turn; ++k) {
      run(stepper, 1);
      spun.momentum = std::max(spun.momentum, (velocity(stepper, 0) - v0).norm() / v0.norm());
      spun.angular_momentum =
          std::max(spun.angular_momentum, std::abs(angular_momentum(stepper, 0) / L0 - 1));
      spun.energy_up = std::max(spun.energy_up, mechanical_energy(stepper) / E0 - 1);
      const double area = of.moments(stepper.state()).area / of.reference_area() - 1;
      if (k / steps_a_turn < 10) early.take(area);
      if (k / steps_a_turn >= turns - 10) late.take(area);
    }
  });
  spun.energy_end = mechanical_energy(stepper) / E0 - 1;
  spun.stretch = steady_stretch(of, model, angular_velocity(stepper, 0));
  spun.area_error = late.sum / (10 * steps_a_turn) - spun.stretch;
  spun.swing = (late.most - late.least) / 2;
  spun.swing_growth = late.most - early.most;
  return spun;
}

void thousand_turns(Report& report) {
  report.paragraph("### A thousand turns");
  report.paragraph(
      "A free block without gravity, E = 35 GPa, turns once a second and flies at 3.2 m/s. It is a pentagon "
      "of 3.3 m2 without any symmetry, as a Wachspress block and with the six affine unknowns, 100 steps a "
      "turn. It starts unstretched, so that it also vibrates about its centrifugal stretch: for ever with "
      "the conserving scheme, until that has died away with the decaying one. The stretch is known: in the "
      "turning frame K u = ω² M (X + u), with ω the angular velocity at the end.");
  std::vector<std::vector<std::string>> rows{{"block", "scheme", "momentum", "angular momentum",
                                              "energy, highest", "energy, end", "stretch of area",
                                              "mean area beyond it", "swing of area", "its growth", "s"}};
  double linear = 0, angular = 0, up = -1, area = 0;
  for (const BlockModel model : {BlockModel::wachspress, BlockModel::affine})
    for (const Scheme scheme : {Scheme::midpoint, Scheme::decaying}) {
      const Spun spun = spin(model, scheme);
      rows.push_back({model == BlockModel::affine ? "affine" : "Wachspress",
                      scheme == Scheme::midpoint ? "midpoint" : "decaying", text(spun.momentum),
                      text(spun.angular_momentum), text(spun.energy_up), text(spun.energy_end),
                      text(spun.stretch), text(spun.area_error), text(spun.swing), text(spun.swing_growth),
                      fmt::format("{:.1f}", spun.seconds)});
      linear = std::max(linear, spun.momentum);
      angular = std::max(angular, spun.angular_momentum);
      up = std::max(up, spun.energy_up);
      area = std::max({area, std::abs(spun.area_error), spun.swing_growth});
    }
  report.table(rows);
  report.claims({{"Linear momentum stays to 1e-12.", linear <= 1e-12, text(linear)},
                 {"Angular momentum stays to 1e-6.", angular <= 1e-6, text(angular)},
                 {"Energy is never up by 1e-6.", up <= 1e-6, text(up)},
                 {"Area is that of the centrifugal stretch to 1e-8, and its swing does not grow.",
                  area <= 1e-8, text(area)}});
}

/// A law of facts: what n steps make of angular momentum, angular velocity or area, over that at the start.
struct Law {
  const char* who;
  Scheme scheme;
  Kinematics kinematics;
  BlockModel model;
  const char* quantity;
  double (*measure)(const Stepper&);
  const char* formula;
  double (*predict)(double n, double w2);  ///< w2 = (w0 dt)^2
  double young = 35e9;
};

double measured_area(const Stepper& stepper) {
  const Block& block = stepper.blocks().block(0);
  return block.moments(stepper.state()).area / block.reference_area();
}
double measured_speed(const Stepper& stepper) {
  return angular_velocity(stepper, 0) / turn;
}
double measured_momentum(const Stepper& stepper) {
  return angular_momentum(stepper, 0);
}
double one_by_root(double n, double w2) {
  return 1 / std::sqrt(1 + n * w2);
}
double twice_as_much(double n, double w2) {
  return 1 / std::sqrt(1 + 2 * n * w2);
}
double nothing(double, double) {
  return 1;
}
double grows_linearly(double n, double w2) {
  return 1 + n * w2;
}
double grows_by_power(double n, double w2) {
  return std::pow(1 + w2, n);
}

constexpr auto turning = Kinematics::corotational, adding = Kinematics::incremental;
constexpr auto vertices = BlockModel::wachspress, six = BlockModel::affine;
constexpr Law laws[] = {
    {"dda, corotational", Scheme::dda, turning, vertices, "angular momentum", measured_momentum,
     "1/√(1 + n (ω₀Δt)²)", one_by_root},
    {"backward Euler, corotational", Scheme::backward_euler, turning, vertices, "angular momentum",
     measured_momentum, "1/√(1 + 2 n (ω₀Δt)²)", twice_as_much},
    {"Newmark (1/4, 1/2), corotational, E = 100 MPa", Scheme::newmark, turning, vertices, "angular momentum",
     measured_momentum, "1", nothing, 1e8},
    {"the paper: dda, incremental, vertices", Scheme::dda, adding, vertices, "angular velocity",
     measured_speed, "1/√(1 + n (ω₀Δt)²)", one_by_root},
    {"the paper: dda, incremental, vertices", Scheme::dda, adding, vertices, "area", measured_area,
     "1 + n (ω₀Δt)²", grows_linearly},
    {"original DDA: dda, incremental, six unknowns", Scheme::dda, adding, six, "angular velocity",
     measured_speed, "1", nothing},
    {"original DDA: dda, incremental, six unknowns", Scheme::dda, adding, six, "area", measured_area,
     "(1 + (ω₀Δt)²)ⁿ", grows_by_power},
};

void damped_turns(Report& report) {
  report.paragraph("### How the other schemes turn");
  report.paragraph(
      "Take a rigid body in a scheme whose forces act at the end of the step. They have no moment about the "
      "new shape, so Σ y₁ × M (d − Δt v₀) = 0. With y₀ turned by θ and v₀ = ω J y₀ that is tan θ = ω Δt: the "
      "block turns too little. Newmark (1/2, 1) goes on with v₁ = 2 d/Δt − v₀, whose moment of momentum is "
      "that of ω₁ Δt = sin θ. Hence 1/ω₁² = 1/ω₀² + Δt², and after n steps ω = ω₀/√(1 + n (ω₀Δt)²). Backward "
      "Euler has v₁ = d/Δt. Again ω₁ Δt = sin θ, but the velocity also has a part along y of θ²/2Δt, which "
      "turns the next step by as much less: twice the loss. Increments on the current shape put the vertices "
      "on their tangents instead: the area grows by 1 + (ωΔt)² a step. Six unknowns keep ω, vertices' "
      "displacements keep the moment of velocity over the grown shape. Two turns at 100 steps a turn:");
  std::vector<std::vector<std::string>> rows{
      {"scheme", "quantity", "law", "by the law", "computed", "error"}};
  double worst = 0;
  Chart chart{
      .x_symbol = {"turns", "", ""}, .y_symbol = {"L", "", "/L₀"}, .x_unit = "", .y_unit = "", .series = {}};
  for (const Law& law : laws) {
    const int n = 2 * steps_a_turn;
    const BuiltScene built =
        build(spin_scene(law.model, law.scheme, law.kinematics, n, time_step, law.young));
    Stepper& stepper = *built.stepper;
    const double start = law.measure(stepper), w2 = std::pow(turn * time_step, 2);
    Series computed{law.who, {}, {}, true}, expected{law.formula, {}, {}};
    double error = 0;
    for (int k = 1; k <= n; ++k) {
      run(stepper, 1);
      const double seen = law.measure(stepper) / start, predicted = law.predict(k, w2);
      error = std::max(error, std::abs(seen / predicted - 1));
      expected.x.push_back(k / double(steps_a_turn));
      expected.y.push_back(predicted);
      if (k % 10 == 0) {
        computed.x.push_back(k / double(steps_a_turn));
        computed.y.push_back(seen);
      }
    }
    worst = std::max(worst, error);
    rows.push_back({law.who, law.quantity, law.formula, fmt::format("{:.4f}", law.predict(n, w2)),
                    fmt::format("{:.4f}", law.measure(stepper) / start), text(error)});
    if (law.measure == measured_momentum) {
      chart.series.push_back(expected);
      chart.series.push_back(computed);
    }
  }
  report.table(rows);
  std::stable_partition(chart.series.begin(), chart.series.end(), [](const Series& s) { return !s.markers; });
  report.picture(
      "mechanics_spinning",
      draw({chart}, {.title = "Angular momentum of a free block, 100 steps a turn", .plot_height = 260}),
      "Angular momentum by the schemes that damp rotation: laws (lines) and computed (marks).");
  report.claims(
      {{"Every scheme follows its law to 1 %.", worst <= 0.01, fmt::format("{:.1e} at worst", worst)}});
}

/// Where the trapezoidal rule leaves its law.
void unstable_trapezoid(Report& report) {
  report.paragraph(
      "Newmark's trapezoidal rule (1/4, 1/2) keeps angular momentum to second order in the step while the "
      "block is soft. Where the vibrations are much faster than the step, accelerations that alternate from "
      "step to step are not damped, and turning feeds them. The scheme is not stable then, whatever is said "
      "of linear vibrations. A γ a little above 1/2 is, but damps the turning. Angular momentum over that at "
      "the start after two turns at 100 steps a turn:");
  std::vector<std::vector<std::string>> rows{{"E", "(1/4, 1/2)", "γ = 0.6, β = (γ + 1/2)²/4"}};
  for (const double young : {1e8, 1e9, 1e10, 35e9}) {
    std::vector<std::string> row{fmt::format("{:g} GPa", young / 1e9)};
    for (const double gamma : {0.5, 0.6}) {
      Scene scene = spin_scene(vertices, Scheme::newmark, turning, 2 * steps_a_turn, time_step, young);
      scene.analysis.gamma = gamma;
      scene.analysis.beta = (gamma + 0.5) * (gamma + 0.5) / 4;
      const BuiltScene built = build(scene);
      const double start = angular_momentum(*built.stepper, 0);
      run(*built.stepper, scene.analysis.steps);
      row.push_back(fmt::format("{:.4f}", angular_momentum(*built.stepper, 0) / start));
    }
    rows.push_back(row);
  }
  report.table(rows);
}

/// The angle after ten turns against w t.
void error_against_time(Report& report) {
  report.paragraph("### Error against run time");
  report.paragraph(
      "The angle turned in ten seconds, against ten turns, over the length of the step. Schemes that damp "
      "rotation are of "
      "first order; the conserving and the decaying one are of second.");
  Chart chart{.x_symbol = {"run time", "", ""},
              .y_symbol = {"error of the angle", "", ""},
              .x_unit = "ms",
              .y_unit = "rad",
              .series = {},
              .x_logarithmic = true,
              .y_logarithmic = true};
  std::vector<std::vector<std::string>> rows{{"steps a turn"}};
  for (const NamedScheme& scheme : schemes) rows[0].push_back(scheme.name);
  for (const int n : {50, 100, 200, 500, 1000}) rows.push_back({fmt::format("{}", n)});
  for (const NamedScheme& scheme : schemes) {
    Series series{scheme.name, {}, {}};
    series.dots = true;
    std::size_t row = 0;
    for (const int n : {50, 100, 200, 500, 1000}) {
      double angle = std::numeric_limits<double>::quiet_NaN();
      const double seconds = seconds_of([&] {
        try {
          angle =
              run(spin_scene(vertices, scheme.scheme, turning, 10 * n, 1. / n)).stepper->state().rotation[0];
        } catch (const Error&) {  // stopped: no angle to show
        }
      });
      const double error = std::abs(angle - 10 * turn);
      series.x.push_back(1e3 * seconds);
      series.y.push_back(error);
      rows[++row].push_back(std::isfinite(error) ? text(error) : "stopped");
    }
    chart.series.push_back(series);
  }
  report.table(rows);
  report.picture("mechanics_spinning_cost",
                 draw({chart}, {.title = "Ten turns of a free block", .plot_height = 260}),
                 "Error of the angle after ten turns (rad) against run time, by scheme.");
}

}  // namespace

void spinning(Report& report) {
  report.heading("1. Spinning");
  thousand_turns(report);
  damped_turns(report);
  unstable_trapezoid(report);
  error_against_time(report);
}

}  // namespace verification
