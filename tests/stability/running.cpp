// What runs must keep: balance, momenta, cones, energy; and what they must survive.
#include "chapters.hpp"
#include "forces.hpp"
#include "scenes.hpp"
#include "solver_scenes.hpp"

#include <tests/support/random_scenes.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

namespace stability {

namespace {

/// Three squares upon each other, from below.
struct Ratio {
  const char* name;
  double density[3], young[3];
};
constexpr Ratio ratios_of_facts[] = {
    {"heavy on light", {25, 25, 2.5e7}, {35e9, 35e9, 35e9}},
    {"light on heavy", {2.5e7, 25, 25}, {35e9, 35e9, 35e9}},
    {"heavy between light", {25, 2.5e7, 25}, {35e9, 35e9, 35e9}},
    {"stiff on soft", {2500, 2500, 2500}, {35e6, 35e6, 35e12}},
    {"soft on stiff", {2500, 2500, 2500}, {35e12, 35e6, 35e6}},
    {"soft and light on stiff and heavy", {2.5e7, 25, 25}, {35e12, 35e6, 35e6}},
};

/// Steps until it rests, and those after in which states are compared.
constexpr int settling = 1000, watched = 500;

struct Carried {
  double error = 0;  ///< of a contact force, over the weight it carries
  int flips = 0;
  std::string stopped_by;
};

Carried carry(const Ratio& ratio, Mode mode, double start_of_springs) {
  Scene scene = stack_scene(3, 0.01, 1);
  scene.analysis.mode = mode;
  scene.materials.clear();
  for (int k = 0; k < 3; ++k) {
    scene.materials.push_back({fmt::format("{}", k), ratio.density[k], ratio.young[k], 0.3});
    scene.blocks[static_cast<std::size_t>(k) + 1].material = k;
  }
  scene.contact.normal_stiffness = start_of_springs;
  scene.contact.tangential_stiffness = start_of_springs / 2.5;
  Carried carried;
  const BuiltScene built = build(scene);
  Stepper& stepper = *built.stepper;
  std::vector<ContactState> before;
  for (int k = 0; k < settling + watched; ++k) {
    if (!stepper.step()) {
      carried.stopped_by = stepper.stop_reason();
      carried.error = 1;
      return carried;
    }
    if (k < settling) continue;
    if (k > settling) carried.flips += states(stepper) != before;
    before = states(stepper);
    double weight = 0;
    for (int b = 2; b >= 0; --b) {
      weight += ratio.density[b] * gravity;
      carried.error = std::max(carried.error,
                               std::abs(verification::normal_force_between(stepper, b, b + 1) / weight - 1));
    }
  }
  return carried;
}

}  // namespace

void ratios(Page& page) {
  Report& report =
      page.begin({"Mass or stiffness ratio 1e6",
                  "contact forces within 1e-6 of the weight, no flipping states", "mechanics.md 5"});
  report.paragraph(
      "Three squares of 1 m lie upon each other, Δt = 0.01 s. The table has the largest error of a contact "
      "force over the weight it carries in the last 500 of 1500 steps. It also has how often a contact's "
      "state is another one than the step before. Springs start at the softest modulus, and at 40 times the "
      "stiffest one as in scenes that state none. What flips is a light block on a heavy one. The heavy one "
      "spreads under its own weight and draws the light one's corners apart until friction is at its bound, "
      "where sticking and slipping are both right. Forces stray in single steps, by a spring times the last "
      "digits of a coordinate (mechanics.md looks after the last step only).");
  std::vector<std::vector<std::string>> rows{
      {"stack", "dynamic, soft start", "static, soft start", "dynamic, default", "static, default"}};
  double worst[2] = {0, 0};
  int flips = 0;
  for (const Ratio& ratio : ratios_of_facts) {
    std::vector<std::string> row{ratio.name};
    for (const bool soft : {true, false})
      for (const Mode mode : {Mode::dynamic, Mode::statics}) {
        const double start = soft ? *std::min_element(ratio.young, ratio.young + 3)
                                  : 40 * *std::max_element(ratio.young, ratio.young + 3);
        const Carried carried = carry(ratio, mode, start);
        worst[soft ? 0 : 1] = std::max(worst[soft ? 0 : 1], carried.error);
        flips += carried.flips;
        row.push_back(carried.stopped_by.empty()
                          ? fmt::format("{}, {} flips", figure(carried.error), carried.flips)
                          : "stopped: " + carried.stopped_by);
      }
    rows.push_back(row);
  }
  report.table(rows);
  page.claims({{"Contact forces within 1e-6 of the weight, springs that start soft.", worst[0] <= 1e-6,
                figure(worst[0])},
               {"The same with the springs that scenes have by default.", worst[1] <= 1e-6, figure(worst[1])},
               {"No flipping states.", flips == 0, fmt::format("{} steps", flips)}});
}

namespace {

struct SteppedScenes {
  int runs = 0, stopped = 0, cut = 0, not_finite = 0, silent = 0;
  std::vector<std::string> stopped_by;
};

/// Three steps of so many times the scene's own length; what stops must say why.
SteppedScenes step_by(const std::vector<NamedScene>& scenes, double factor) {
  SteppedScenes all;
  for (const NamedScene& named : scenes) {
    Scene scene = named.scene;
    scene.analysis.time_step *= factor;
    const Run run = run_to_end(scene, 3);
    ++all.runs;
    all.cut += run.counts.rejected > 0 || run.counts.substeps > run.counts.steps;
    all.not_finite += !run.finite;
    const bool stopped = run.counts.steps < std::min(3, scene.n_steps());
    all.stopped += stopped;
    all.silent += stopped && run.stopped_by.empty();
    if (stopped) all.stopped_by.push_back(named.name + ": " + run.stopped_by);
  }
  return all;
}

}  // namespace

void time_steps(Page& page) {
  Report& report = page.begin({"Time step x 1e6, x 1e-9", "converges, or cut with a message",
                               "`FreeMotion.ALimitThatNoSubstepMeetsStopsTheRunAndNamesTheBlock`"});
  std::vector<NamedScene> scenes = scenes_of_every_kind();
  std::erase_if(scenes, [](const NamedScene& named) { return named.takes_long; });
  std::vector<std::vector<std::string>> rows{
      {"time step", "scenes", "made three steps", "in smaller ones", "stopped with a message", "NaN"}};
  int not_finite = 0, silent = 0;
  std::vector<std::string> messages;
  for (const double factor : {1e6, 1e3, 1e-5, 1e-9}) {
    const SteppedScenes all = step_by(scenes, factor);
    rows.push_back({fmt::format("x {:g}", factor), fmt::format("{}", all.runs),
                    fmt::format("{}", all.runs - all.stopped), fmt::format("{}", all.cut),
                    fmt::format("{}", all.stopped), fmt::format("{}", all.not_finite)});
    not_finite += all.not_finite;
    silent += all.silent;
    if (messages.empty()) messages = all.stopped_by;
  }
  report.table(rows);
  page.claims({{"Never a NaN.", not_finite == 0, fmt::format("{}", not_finite)},
               {"What stops says why and where.", silent == 0,
                messages.empty() ? "nothing stopped" : "for instance " + messages.front()}});
}

void spinning(Page& page) {
  page.begin(
      {"Free block, 1000 turns, conserving scheme",
       "area 1e-8 beyond its centrifugal stretch, angular momentum 1e-6, energy never up by 1e-6; the "
       "paper's scheme follows its laws to 1 %",
       "`Spinning*`, `SpinningCorotationalBlock.*`, `FreeMotion.ASpinning*`, computed in mechanics.md 1"});
  page.claims({Page::quoted("mechanics.md",
                            "Area is that of the centrifugal stretch to 1e-8, and its swing does not grow."),
               Page::quoted("mechanics.md", "Angular momentum stays to 1e-6."),
               Page::quoted("mechanics.md", "Energy is never up by 1e-6."),
               Page::quoted("mechanics.md", "Every scheme follows its law to 1 %.")});
}

void resting(Page& page) {
  page.begin({"Stack of 100 at rest, 1e5 steps",
              "creep at most 1e-9 L after settling, reactions = weight to 1e-8, no state change",
              "mechanics.md 5 (2000 steps)"});
  page.claims({page.recorded("Creep at most 1e-9 L.", "stack creep"),
               page.recorded("Reactions are the weight to 1e-8.", "stack reaction"),
               page.recorded("No state changes.", "stack states")});
}

void slope(Page& page) {
  page.begin({"Slope at mu = tan a (1 +- 1e-6)", "stays / slides with the right acceleration",
              "computed in mechanics.md 3"});
  page.claims({Page::quoted("mechanics.md", "At μ = tan a (1 + 1e-6) the block stays (below 1e-9 m/s)."),
               Page::quoted("mechanics.md",
                            "At μ = tan a (1 − 1e-6) it slides with the right acceleration, to 1 %.")});
}

void momentum(Page& page) {
  Report& report = page.begin({"Linear momentum without external force",
                               "1e-12 of the sum of all blocks' m v per 1e4 steps",
                               "`Impact.OfTwoFreeBlocksKeepsMomentaAndMakesNoEnergy`, mechanics.md 4"});
  report.paragraph(
      "Four bonded squares that fly and turn, whose contacts bear in every step, and a block that bounces to "
      "and "
      "fro in a free box of bonded walls ten times as dense. The largest change in 1000 steps of 1e-3 and "
      "1e-2 s:");
  std::vector<std::vector<std::string>> rows{{"scheme", "bonded squares", "bouncing in a box"}};
  double worst = 0;
  for (const verification::NamedScheme& scheme : verification::schemes) {
    if (scheme.scheme == Scheme::newmark) continue;  // not stable for stiff blocks that turn
    const double flying = momentum_drift(flying_assembly(scheme.scheme), 1000),
                 bouncing = momentum_drift(bouncing_in_a_box(scheme.scheme), 1000);
    worst = std::max({worst, flying, bouncing});
    rows.push_back({scheme.name, figure(flying), figure(bouncing)});
  }
  report.table(rows);
  page.claims({{"1e-12 in 1000 steps.", worst <= 1e-12, figure(worst)},
               page.recorded("1e-12 in 1e4 steps.", "momentum")});
}

void contact_forces(Page& page) {
  Report& report = page.begin({"Every contact", "dissipation >= 0, inside the cone to 1e-12",
                               "`Rest.ContactForcesStayInsideTheCone`, "
                               "`RigidVelocities.EveryContactOpensSticksOrSlidesAgainstItsFriction`"});
  constexpr int n_scenes = 90;
  ContactCheck worst;
  std::string worst_scene;
  for (std::uint64_t seed = 0; seed < n_scenes; ++seed) {
    const Scene scene = support::random_drop(seed);
    const ContactCheck check = check_contacts(scene, std::min(30, scene.n_steps()));
    worst.contacts += check.contacts;
    if (check.outside > worst.outside)
      worst_scene = fmt::format("{} ({})", seed, name_of(support::drop_kind(seed)));
    worst.outside = std::max(worst.outside, check.outside);
    worst.work = std::max(worst.work, check.work);
    worst.work_over_energy = std::max(worst.work_over_energy, check.work_over_energy);
    worst.dissipation_falls = std::max(worst.dissipation_falls, check.dissipation_falls);
  }
  report.paragraph(
      fmt::format("{} random scenes of support/random_scenes, 30 steps each. After every step each closed "
                  "contact's forces are compared with its cone, over the largest contact force there is. So "
                  "is the work of its friction in the slip of the step, over the friction times the block's "
                  "size.",
                  n_scenes));
  page.claims({{"Inside the cone to 1e-12.", worst.outside <= 1e-12,
                fmt::format("{} at {} contacts{}", figure(worst.outside), worst.contacts,
                            worst.outside > 1e-12 ? ", scene " + worst_scene : "")},
               {"Friction works against the slip of each contact, to 1e-12 L.", worst.work <= 1e-12,
                figure(worst.work) +
                    " L: what the tolerance of sticking contacts (1e-6 L) leaves of their springs is "
                    "let go when they begin to slide"},
               {"Work so gained, over the largest energy in the scene: below 1e-6.",
                worst.work_over_energy <= 1e-6, figure(worst.work_over_energy)},
               {"What friction and impacts have dissipated never falls by more (1e-6).",
                worst.dissipation_falls <= 1e-6, figure(worst.dissipation_falls)},
               page.recorded("Inside the cone to 1e-12: 450 random scenes to their ends.", "cone"),
               page.recorded("Friction works against the slip to 1e-12 L: the same.", "slip"),
               page.recorded("Dissipation never falls by 1e-6 of the energy: the same.", "dissipation"),
               page.recorded("All run to their ends.", "scenes stopped")});
}

namespace {

/// The cells of the row of a table that begins with `first`.
std::vector<std::string> row_of_table(const std::string& path, const std::string& first) {
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("| " + first + " |")) continue;
    std::vector<std::string> cells;
    std::istringstream rest(line.substr(1));
    for (std::string cell; std::getline(rest, cell, '|');) cells.push_back(cell.substr(1, cell.size() - 2));
    return cells;
  }
  throw Error("\"" + path + "\" has no row \"" + first + "\"");
}

}  // namespace

void drops(Page& page) {
  page.begin({"1e4 random drops, wedges, T-joints, vertex on vertex",
              "overlap at most 1e-4 L^2 at every output, no tunnelling",
              "`AnyDrops.*`, `AnyShape.*`; recorded by `any_drops` in doc/benchmarks/any_drops.md"});
  const std::vector<std::string> header = row_of_table(POLYDDA_ANY_DROPS, "ground"),
                                 all = row_of_table(POLYDDA_ANY_DROPS, "all");
  const auto cell = [&](const std::string& column) {
    return all.at(static_cast<std::size_t>(std::find(header.begin(), header.end(), column) - header.begin()));
  };
  const std::string of = " of " + cell("drops") + " drops";
  page.claims({{"Overlap at most 1e-4 after every step.", cell("too much overlap") == "0",
                cell("too much overlap") + of + ", " + cell("overlap") + " at most"},
               {"Nothing passes through anything.", cell("passed") == "0", cell("passed") + of},
               {"All run to their ends.", cell("stopped") == "0", cell("stopped") + of}});
}

namespace {

struct Started {
  double gained = 0;  ///< mechanical energy at most, over the weight times the size
  double moved = 0;   ///< m
  std::string refused;
};

/// A square pressed into the one below it by `depth`, at rest and without gravity; or into two at a time.
Started start_overlapping(double depth, Mode mode, int kind) {
  Scene scene = rock_scene(1e-3, 100);
  scene.analysis.mode = mode;
  scene.analysis.gravity.setZero();
  scene.joints[0].friction_angle = 30;
  scene.joints[0].restitution = 0.5;
  scene.blocks = {block(rectangle(-2, -1, 5, 1), true), block(rectangle(0, -depth, 1, 1))};
  if (kind == 1) scene.blocks.push_back(block(rectangle(0.3, 1 - 2 * depth, 1, 1)));
  if (kind == 2) scene.blocks[1].vertices = turned(rectangle(0, 0, 1, 1), 0.7).colwise() + Vec2(0, -depth);
  Started started;
  Scene checked;
  try {
    checked = as_read(scene);
  } catch (const Error& error) {
    started.refused = error.what();
    return started;
  }
  const BuiltScene built = build(checked);
  for (int k = 0; k < scene.n_steps() && built.stepper->step(); ++k)
    started.gained = std::max(started.gained, verification::mechanical_energy(*built.stepper));
  started.gained /= 2500 * gravity;
  started.moved = verification::travel(*built.stepper, 1).norm();
  return started;
}

}  // namespace

void overlaps(Page& page) {
  Report& report =
      page.begin({"Overlapping start, 1e-12 L to 0.5 L", "no energy created; large: refused by name",
                  "`Rest.AnInitialOverlapMakesNoForce`, `Overlap.*`"});
  report.paragraph(
      "A square on a fixed floor, two upon each other, and one on a corner overlap by as much. They are read "
      "from a file and at rest without gravity, E = 35 GPa, for 100 steps of 1 ms. The table has the energy "
      "that appears over a block's weight times its size, dynamic and static, at most, and how far it "
      "moves.");
  std::vector<std::vector<std::string>> rows{{"overlap", "energy", "moves, m", "refused"}};
  double gained = 0;
  int wrongly_taken = 0, wrongly_refused = 0;
  std::string message;
  for (const double depth : {1e-12, 1e-9, 1e-6, 1e-4, 9.9e-4, 1.1e-3, 1e-2, 0.1, 0.5}) {
    Started all;
    int refused = 0, runs = 0;
    for (const Mode mode : {Mode::dynamic, Mode::statics})
      for (int kind = 0; kind < 3; ++kind) {
        const Started started = start_overlapping(depth, mode, kind);
        ++runs;
        if (!started.refused.empty()) {
          ++refused;
          message = started.refused;
          wrongly_refused += depth <= 1e-3 || message.find("overlap") == std::string::npos;
        } else {
          wrongly_taken += depth > 1e-3;
        }
        all.gained = std::max(all.gained, started.gained);
        all.moved = std::max(all.moved, started.moved);
      }
    gained = std::max(gained, all.gained);
    rows.push_back(
        {figure(depth), figure(all.gained), figure(all.moved), fmt::format("{} of {}", refused, runs)});
  }
  report.table(rows);
  page.claims({{"No energy is created (1e-12 of weight times size).", gained <= 1e-12, figure(gained)},
               {"Above 1e-3 L they are refused by name, below not.",
                wrongly_taken == 0 && wrongly_refused == 0, message}});
}

void interruptions(Page& page) {
  page.begin(
      {"Killed 30 times at random, resumed", "the same bytes",
       "`Resume.KilledThirtyTimesAtRandomTheSameFiles`, `Resume.AnyStepOfEveryExampleGivesTheSameFiles`"});
}

}  // namespace stability
