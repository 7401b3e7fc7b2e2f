/// \file What of doc/verification/stability.md takes minutes: `stability_long FILE [RECORDED]` writes a line
/// `name,passes,figures` for each thing asked; given those recorded before it fails where one passes no more,
/// or does now.
#include "changes.hpp"
#include "forces.hpp"
#include "page.hpp"
#include "solver_scenes.hpp"

#include <tests/support/any_drops.hpp>
#include <tests/support/random_scenes.hpp>

#include <fmt/format.h>
#include <polyfem/assembly/blas.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <fstream>

namespace {

using namespace stability;

class Record {
 public:
  explicit Record(const std::string& path) : out_(path) {}
  void add(const std::string& name, bool passes, const std::string& figures) {
    out_ << name << (passes ? ",yes," : ",no,") << figures << std::endl;
    fmt::print("{}: {}: {}\n", name, passes ? "yes" : "no", figures);
    if (!out_) throw polyfem::Error("cannot write the record");
  }

 private:
  std::ofstream out_;
};

/// Random scenes of convex and of any shapes, 10 to 40 steps each.
std::vector<NamedScene> random_scenes(int of_drops, int of_any) {
  std::vector<NamedScene> scenes;
  for (int k = 0; k < of_drops; ++k)
    scenes.push_back({fmt::format("drop {}", k), support::random_drop(static_cast<std::uint64_t>(k)), false});
  for (int k = 0; k < of_any; ++k)
    scenes.push_back(
        {fmt::format("any shapes {}", k), support::any_drop(static_cast<std::uint64_t>(k)), false});
  for (NamedScene& named : scenes) named.scene.analysis.steps = std::min(named.scene.analysis.steps, 40);
  return scenes;
}

void moved(Record& record, const std::vector<NamedScene>& scenes) {
  double furthest = 0;
  int others = 0;
  for (const NamedScene& named : scenes) {
    const Scene here = support::on_grid(named.scene, std::ldexp(1, -20));
    const Run base = run_to_end(here, here.n_steps());
    for (const Vec2& by : {Vec2(5e5, 4e6), Vec2(1e7, -1e7)}) {
      const Run there = run_to_end(support::moved(here, by), here.n_steps());
      furthest = std::max(furthest, distance(base, there) / smallest_size(here));
      others += !same_counts(base, there);
    }
  }
  record.add("moved", others == 0 && furthest <= 1e-9,
             fmt::format("{} scenes; {} runs with other counts; {} L apart", scenes.size(), others,
                         figure(furthest)));
}

void scaled(Record& record, const std::vector<NamedScene>& scenes) {
  std::vector<std::string> others;
  for (const NamedScene& named : scenes) {
    const Run base = run_to_end(named.scene, named.scene.n_steps());
    bool same = true;
    for (const Restatement& units : binary_units()) {
      if (!same) break;
      const Run other = run_to_end(units.restated(named.scene), named.scene.n_steps());
      same = same_bits(base, units.read_back(other));
    }
    if (!same) others.push_back(named.name);
  }
  record.add("scaled", others.empty(),
             fmt::format("{} scenes in {} units; {} with other bits{}", scenes.size(), binary_units().size(),
                         others.size(), others.empty() ? "" : ", first " + others.front()));
}

void seen_otherwise(Record& record, const std::string& name, const std::vector<NamedScene>& scenes,
                    const std::vector<Restatement>& restatements) {
  constexpr double asked = 1e-10;
  int hanging = 0, apart = 0;
  double worst = 0;
  std::string worst_scene;
  for (const NamedScene& named : scenes) {
    const Agreement agreement = compare(named, restatements, 10);
    apart += agreement.apart > asked;
    if (agreement.hangs_on_last_digits()) {
      ++hanging;
    } else if (agreement.apart > worst) {
      worst = agreement.apart;
      worst_scene = fmt::format(" ({}, {})", named.name, agreement.worst);
    }
  }
  record.add(
      name, apart == 0,
      fmt::format(
          "{} scenes, 10 steps, {} ways: {} apart by more than 1e-10 L; {} depend on their last digits; "
          "the others {} L apart at most{}",
          scenes.size(), restatements.size(), apart, hanging, figure(worst), worst_scene));
}

void stack_at_rest(Record& record) {
  constexpr int n = 100, settling = 1000, steps = 100000;
  const BuiltScene built = build(stack_scene(n, 0.01, 1));
  Stepper& stepper = *built.stepper;
  verification::run(stepper, settling);
  const Points before = stepper.blocks().displacements(stepper.state());
  const std::vector<ContactState> states_before = states(stepper);
  double creep = 0, reaction = 0;
  long flips = 0;
  const double floor = 5 * 2500 * gravity, weight = n * 2500 * gravity;
  for (int k = 0; k < steps; ++k) {
    verification::run(stepper, 1);
    flips += states(stepper) != states_before;
    const Vec2 all = stepper.reactions().rowwise().sum();
    reaction = std::max({reaction, std::abs(all.y() - floor - weight) / weight, std::abs(all.x()) / weight});
    if (k % 100 == 99)
      creep = std::max(
          creep, (stepper.blocks().displacements(stepper.state()) - before).colwise().norm().maxCoeff());
  }
  record.add("stack creep", creep <= 1e-9, figure(creep) + " m");
  record.add("stack reaction", reaction <= 1e-8, figure(reaction));
  record.add("stack states", flips == 0, fmt::format("{} of {} steps", flips, steps));
}

void contacts(Record& record) {
  constexpr int n_scenes = 450;
  ContactCheck worst;
  int stopped = 0;
  for (std::uint64_t seed = 0; seed < n_scenes; ++seed) {
    const Scene scene = support::random_drop(seed);
    const ContactCheck check = check_contacts(scene, scene.n_steps());
    worst.contacts += check.contacts;
    worst.outside = std::max(worst.outside, check.outside);
    worst.work = std::max(worst.work, check.work);
    worst.work_over_energy = std::max(worst.work_over_energy, check.work_over_energy);
    worst.dissipation_falls = std::max(worst.dissipation_falls, check.dissipation_falls);
    stopped += !check.stopped_by.empty();
  }
  const std::string of = fmt::format(" of {} contacts in {} scenes", worst.contacts, n_scenes);
  record.add("cone", worst.outside <= 1e-12, figure(worst.outside) + of);
  record.add("slip", worst.work <= 1e-12, figure(worst.work) + " L" + of);
  record.add("dissipation", std::max(worst.work_over_energy, worst.dissipation_falls) <= 1e-6,
             fmt::format("{} by one contact, {} in all", figure(worst.work_over_energy),
                         figure(worst.dissipation_falls)));
  record.add("scenes stopped", stopped == 0, fmt::format("{} of {}", stopped, n_scenes));
}

void momentum(Record& record) {
  double worst = 0;
  std::string figures;
  for (const verification::NamedScheme& scheme : verification::schemes) {
    if (scheme.scheme == Scheme::newmark) continue;
    const double flying = momentum_drift(flying_assembly(scheme.scheme), 10000),
                 bouncing = momentum_drift(bouncing_in_a_box(scheme.scheme), 10000);
    worst = std::max({worst, flying, bouncing});
    figures += fmt::format("{}{}: {} bonded, {} bouncing", figures.empty() ? "" : "; ", scheme.name,
                           figure(flying), figure(bouncing));
  }
  record.add("momentum", worst <= 1e-12, figures);
}

bool as_recorded(const std::string& made, const std::string& before) {
  const LongRecord now = read_long_record(made), then = read_long_record(before);
  bool same = now.size() == then.size();
  for (const auto& [name, entry] : then) {
    const auto found = now.find(name);
    if (found != now.end() && found->second.passes == entry.passes) continue;
    same = false;
    fmt::print(stderr, "\"{}\" is recorded otherwise: {}\n", name, entry.figures);
  }
  return same;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 && argc != 3) {
    fmt::print(stderr, "usage: stability_long FILE [RECORDED]\n");
    return 2;
  }
  try {
    polyfem::pin_blas_to_one_thread();
    {
      Record record(argv[1]);
      const std::vector<NamedScene> scenes = random_scenes(54, 24);
      momentum(record);
      moved(record, scenes);
      scaled(record, scenes);
      seen_otherwise(record, "units", scenes, decimal_units());
      seen_otherwise(record, "turned", scenes, other_views());
      contacts(record);
      stack_at_rest(record);
    }
    return argc == 3 && !as_recorded(argv[1], argv[2]) ? 1 : 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "stability_long: error: {}\n", error.what());
    return 1;
  }
}
