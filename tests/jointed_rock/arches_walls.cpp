/// \file Arches and walls below and above the load that they can carry, in static steps of very different
/// lengths.
#include "chapters.hpp"

#include <ddacontact/scene/builder.hpp>
#include <tests/support/random_arches_walls.hpp>

#include <fmt/format.h>

#include <array>

namespace jointed_rock {

namespace {

using namespace ddacontact;
using support::LoadedMasonry;

constexpr int n_structures = 100;
constexpr std::array time_steps{0.005, 0.05, 0.5};                          // s
constexpr std::array factors{0.7, 0.85, 0.96, 0.99, 1.01, 1.04, 1.2, 1.5};  // of the limit
constexpr int most_steps = 1000;
constexpr double at_rest = 1e-4;   // of g: a static step leaves less
constexpr double collapsed = 0.1;  // m

enum class Result { rests, collapses, stops };

/// Static steps until one leaves no acceleration, or the structure has moved far, or there are no more. A
/// static step of length dt begins at rest, and what is out of balance moves it by a dt^2.
Result settle(Scene scene, double time_step) {
  scene.analysis.mode = Mode::statics;
  scene.analysis.time_step = time_step;
  scene.analysis.steps = most_steps;
  const BuiltScene built = build(scene);
  Stepper& stepper = *built.stepper;
  const auto displacements = [&] { return stepper.blocks().displacements(stepper.state()); };
  for (int k = 0; k < most_steps; ++k) {
    const Points before = displacements();
    if (!stepper.step()) return Result::stops;
    const Points now = displacements();
    const double acceleration = (now - before).colwise().norm().maxCoeff() / (time_step * time_step);
    if (acceleration < at_rest * scene.analysis.gravity.norm()) return Result::rests;
    if (now.colwise().norm().maxCoeff() > collapsed) break;
  }
  return Result::collapses;
}

}  // namespace

void arches_walls(Report& report) {
  report.heading("Arches and walls");
  report.paragraph(
      fmt::format("{} arches and walls that collapse by rocking, so that limit analysis is exact for them "
                  "(`tests/support/random_arches_walls`), at parts of their limit, in static steps. They "
                  "rest when a step of length Δt leaves less than {:g} g, as its displacement over Δt² says. "
                  "They collapse when it does not within {} steps or something has moved by {} m. How many "
                  "are told as they should be:",
                  n_structures, at_rest, most_steps, collapsed));
  std::vector<std::string> head{"structures", "Δt, s"};
  for (const double factor : factors) head.push_back(fmt::format("{:g}", factor));
  std::vector<std::vector<std::string>> rows{head};
  std::vector<LoadedMasonry> structures;
  for (std::uint64_t seed = 0; seed < n_structures; ++seed)
    structures.push_back(support::random_masonry(seed));
  std::vector<Claim> claims;
  for (const double time_step : time_steps) {
    int right = 0, stopped = 0, n = 0;
    for (int kind = 0; kind < support::n_masonry_kinds; ++kind) {
      rows.push_back({support::name_of(static_cast<support::Masonry>(kind)), fmt::format("{:g}", time_step)});
      for (const double factor : factors) {
        int of_kind = 0, right_of_kind = 0;
        for (const LoadedMasonry& structure : structures) {
          if (static_cast<int>(structure.kind) != kind) continue;
          const Result result = settle(support::loaded(structure, factor), time_step);
          ++of_kind;
          right_of_kind += result == (factor < 1 ? Result::rests : Result::collapses);
          stopped += result == Result::stops;
        }
        rows.back().push_back(fmt::format("{} of {}", right_of_kind, of_kind));
        right += right_of_kind;
        n += of_kind;
      }
    }
    claims.push_back({fmt::format("Static steps of {:g} s tell what rests from what collapses.", time_step),
                      right == n, fmt::format("{} of {}, {} stop", right, n, stopped)});
  }
  report.table(rows);
  report.claims(claims);
}

}  // namespace jointed_rock
