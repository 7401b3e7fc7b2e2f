// The same scene elsewhere, in other units, turned, mirrored, with other numbers.
#include "changes.hpp"
#include "chapters.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace stability {

namespace {

constexpr double asked = 1e-10;
constexpr int steps_if_chaotic = 10;

std::vector<NamedScene> short_scenes() {
  std::vector<NamedScene> scenes = scenes_of_every_kind();
  std::erase_if(scenes, [](const NamedScene& named) { return named.takes_long; });
  return scenes;
}

std::string names_of(const std::vector<std::string>& names) {
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

/// What all scenes but those whose last digits decide come to, what all do, and a table of the latter.
void show(Page& page, Report& report, const std::vector<NamedScene>& scenes,
          const std::vector<Restatement>& restatements, std::vector<Claim> claims) {
  std::vector<std::vector<std::string>> rows{{"scene", "apart, over L", "by", "shaken"}};
  double worst = 0;
  int n_plain = 0, n_apart = 0;
  for (const NamedScene& named : scenes) {
    const Agreement agreement = compare(named, restatements, steps_if_chaotic);
    if (agreement.hangs_on_last_digits() || agreement.apart > asked)
      rows.push_back({named.name, figure(agreement.apart), agreement.worst, figure(agreement.shaken)});
    if (!agreement.hangs_on_last_digits()) worst = std::max(worst, agreement.apart);
    n_plain += !agreement.hangs_on_last_digits();
    n_apart += agreement.apart > asked;
  }
  report.paragraph(
      "Some scenes depend on the last digits of their coordinates: sides and corners that touch with a gap "
      "of nothing, of which round-off says which of them bear. The contacts are solved to 1e-6 of a block, "
      "and two of those that do as well leave blocks about as far apart. The table has all scenes whose ten "
      "steps differ by more than 1e-11 L when nothing but the last digit of each coordinate is changed by "
      "lot (\"shaken\", the largest of four). It also has those that are more than 1e-10 L apart. With a "
      "penetration tolerance of 1e-12 instead of 1e-6 the frames agree to 1e-10 L: an augmentation more or "
      "less is the difference.");
  report.table(rows);
  claims.push_back(
      {fmt::format("To 1e-10 L after {} steps: scenes that do not depend on their last digits.",
                   steps_if_chaotic),
       worst <= asked,
       fmt::format("{} in {} scenes, each in {} ways", figure(worst), n_plain, restatements.size())});
  claims.push_back(
      {"The same: all scenes.", n_apart == 0,
       fmt::format("{} of {} scenes differ by more, all of them in the table", n_apart, scenes.size())});
  page.claims(claims);
}

}  // namespace

void moving(Page& page) {
  page.begin({"Whole scene moved by (5e5, 4e6) m or 1e7 m, coordinates multiples of 2^-20 m",
              "same steps and iterations; displacements differ by at most 1e-9 L",
              "`Invariance.AMapsOriginChangesNothingOfTheDefaultMechanics`, mechanics.md 9"});
  const std::vector<NamedScene> scenes = short_scenes();
  double furthest = 0;
  int runs = 0;
  std::vector<std::string> other_counts;
  for (const NamedScene& named : scenes) {
    const Scene here = as_read(support::on_grid(named.scene, std::ldexp(1, -20)));
    const Run base = run_to_end(here, here.n_steps());
    for (const Vec2& by : {Vec2(5e5, 4e6), Vec2(1e7, -1e7)}) {
      const Run there = run_to_end(as_read(support::moved(here, by)), here.n_steps());
      ++runs;
      furthest = std::max(furthest, distance(base, there) / smallest_size(here));
      if (!same_counts(base, there)) other_counts.push_back(named.name);
    }
  }
  page.claims({{"The same steps, substeps, rejected tries, iterations and contacts.", other_counts.empty(),
                fmt::format("{} runs of {} scenes, written and read again; others: {}", runs, scenes.size(),
                            names_of(other_counts))},
               {"Displacements the same to 1e-9 L.", furthest <= 1e-9, figure(furthest)},
               page.recorded("The same for random scenes.", "moved")});
}

void scaling(Page& page) {
  Report& report =
      page.begin({"Lengths, masses, times scaled", "by powers of two: bitwise equal; by 1e-6 to 1e6: 1e-10",
                  "`Invariance.ScalingLengthsByPowersOfTwoScalesEverythingBitByBit`, "
                  "`Invariance.ScalingMassesByPowersOfTwoScalesForcesBitByBit`"});
  const std::vector<NamedScene> scenes = short_scenes();
  std::vector<std::string> other_bits;
  int runs = 0;
  for (const NamedScene& named : scenes) {
    const Run base = run_to_end(named.scene, named.scene.n_steps());
    bool same = true;
    for (const Restatement& units : binary_units()) {
      ++runs;
      const Run other = run_to_end(units.restated(named.scene), named.scene.n_steps());
      same = same && same_bits(base, units.read_back(other));
    }
    if (!same) other_bits.push_back(named.name);
  }
  show(page, report, scenes, decimal_units(),
       {{"By powers of two: displacements, stresses, reactions and counts to the bit.", other_bits.empty(),
         fmt::format("{} runs of {} scenes; others: {}", runs, scenes.size(), names_of(other_bits))},
        page.recorded("The same for random scenes.", "scaled"),
        page.recorded("By powers of ten, to 1e-10 L: random scenes.", "units")});
}

void turning(Page& page) {
  Report& report =
      page.begin({"Rotated, mirrored, vertices or blocks renumbered", "1e-10 (10 steps if chaotic)",
                  "`Invariance.TurningOrMirroringTheSceneTurnsTheResult`, "
                  "`Invariance.TheOrderOfBlocksDoesNotMatter`, "
                  "`AnyPolygon.WhatIsFoundDoesNotDependOnPlaceOrderNumbersOrMirror`"});
  show(page, report, short_scenes(), other_views(), {page.recorded("To 1e-10 L: random scenes.", "turned")});
}

}  // namespace stability
