#include "bars.hpp"

#include "growth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>

namespace step_performance {

using benchmark_page::Table;

namespace {

/// Which rows of a table.
struct Which {
  std::string scene = "wall", start = "sudden";
  double time_step = 1e-2;
  std::string without{};
  double threads = 1;
  std::string method = "default";
};

std::optional<Measurement> find(const std::vector<Measurement>& table, const Which& which, double size) {
  for (const Measurement& m : table)
    if (m.scene == which.scene && m.start == which.start && m.time_step == which.time_step &&
        m.without == which.without && m.threads == which.threads && m.size == size &&
        m.method == which.method && m.steps > 0)
      return m;
  return std::nullopt;
}

class Bars {
 public:
  void add(const std::string& aim, double most, std::optional<double> seen,
           const std::function<std::string(double)>& text) {
    table_.push_back({aim, seen ? text(*seen) : "not measured",
                      !seen           ? "-"
                      : *seen <= most ? "yes"
                                      : "**no**"});
  }
  const Table& table() const { return table_; }

 private:
  Table table_{{"aim", "value", "reached"}};
};

std::string three_digits(double value) {
  return fmt::format("{:.3g}", value);
}

const Which dynamic{.time_step = 1e-4}, explicitly{.time_step = 1e-4, .method = "explicit"};
const Which coarse{.method = "coarse"}, explicit_substeps{.method = "explicit"};
const Which settling{};
const Which settled{.start = "settled", .without = "sleep"};
const Which gliding{.scene = "glide", .start = "settled", .without = "sleep"};

void add_times(const std::vector<Measurement>& table, const Which& which, const std::string& name,
               std::initializer_list<std::pair<double, double>> aims, Bars& bars) {
  for (const auto& [size, seconds] : aims) {
    const auto m = find(table, which, size);
    bars.add(fmt::format("{}, {:.0f} blocks: at most {} a step", name, size, time_text(seconds)), seconds,
             m ? std::optional(m->total) : std::nullopt, time_text);
  }
}

void add_exponent(const std::vector<Measurement>& table, const Which& which, const std::string& name,
                  double most, Bars& bars) {
  std::vector<double> blocks, seconds;
  for (const double size : {1e3, 1e4, 1e5})
    if (const auto m = find(table, which, size)) {
      blocks.push_back(m->blocks);
      seconds.push_back(m->total);
    }
  bars.add(fmt::format("{}: time grows from 1e3 to 1e5 blocks with a power of at most {}", name, most), most,
           blocks.size() == 3 ? std::optional(growth_exponent(blocks, seconds)) : std::nullopt,
           [](double p) { return fmt::format("{:.2f}", p); });
}

}  // namespace

Table bars_table(const Tables& tables) {
  Bars bars;
  for (const double size : {1e3, 1e4, 1e5}) {
    const auto m = find(tables.growth, settling, size);
    bars.add(
        fmt::format("stiff wall, {:.0f} blocks: outside the linear solver at most 30 % of its time", size),
        0.3, m ? std::optional(m->outside() / m->linear()) : std::nullopt,
        [](double ratio) { return fmt::format("{:.0f} %", 100 * ratio); });
  }
  add_times(tables.growth, explicitly, "explicit steps (1e-4 s, 10 GPa)",
            {{1e3, 0.004}, {1e4, 0.04}, {1e5, 0.4}, {1e6, 4.}}, bars);
  add_times(tables.growth, dynamic, "small steps (1e-4 s, 10 GPa)",
            {{1e3, 0.01}, {1e4, 0.1}, {1e5, 1.}, {1e6, 15.}}, bars);
  add_times(tables.growth, coarse, "stiff steps (1e-2 s), sudden, contacts to 1e-3", {{1e3, 0.25}, {1e4, 3}},
            bars);
  add_times(tables.growth, explicit_substeps, "explicit substeps of 1e-2 s, sudden", {{1e3, 0.3}, {1e4, 2.5}},
            bars);
  add_times(tables.walls, {.start = "settled"}, "stiff steps (1e-2 s), settled, asleep",
            {{1e3, 0.03}, {1e4, 0.5}}, bars);
  add_times(tables.growth, settled, "stiff steps (1e-2 s), settled, awake",
            {{1e3, 0.015}, {1e4, 0.25}, {1e5, 8.}}, bars);
  add_times(tables.growth, gliding, "stiff steps (1e-2 s), sliding", {{1e3, 0.03}, {1e4, 0.6}}, bars);
  const auto rest = find(tables.walls, {.start = "settled"}, 200), falls = find(tables.walls, settling, 200);
  bars.add("wall of 200, at rest: at most 0.3 ms a step", 0.3e-3,
           rest ? std::optional(rest->mean) : std::nullopt, time_text);
  bars.add("wall of 200, settling: at most 3 ms a step", 3e-3,
           falls ? std::optional(falls->mean) : std::nullopt, time_text);
  add_exponent(tables.growth, explicitly, "explicit steps", 1.05, bars);
  add_exponent(tables.growth, dynamic, "small steps", 1.1, bars);
  add_exponent(tables.growth, settled, "stiff steps, settled", 1.25, bars);
  const auto large = find(tables.growth, settling, 1e4);
  bars.add("memory without the factor at most 5 kB a block (stiff wall, 1e4 blocks)", 5,
           large ? std::optional(kilobytes(*large)) : std::nullopt,
           [](double kb) { return fmt::format("{:.2f} kB", kb); });
  const Which field{.scene = "field"};
  const auto alone = find(tables.field, field, 0), sleeping = find(tables.field, field, 1e4),
             full = find(tables.field, {.scene = "field", .without = "sleep islands"}, 1e4);
  const bool has_field = alone && sleeping && full;
  bars.add(
      "10 000 resting blocks and a mover: at most 2 x the mover alone and 1 % of the full step", 1,
      has_field ? std::optional(sleeping->total / (2 * alone->total + 0.01 * full->total)) : std::nullopt,
      [&](double ratio) {
        return fmt::format("{} ({} of that; alone {}, all awake {})", time_text(sleeping->total),
                           three_digits(ratio), time_text(alone->total), time_text(full->total));
      });
  const auto awake = find(tables.walls, settled, 1e4), asleep = find(tables.walls, {.start = "settled"}, 1e4);
  const auto rigid = std::ranges::find_if(tables.box2d, [](const RigidWall& w) { return w.bricks > 9e3; });
  for (const auto& [name, m] : {std::pair("all awake", awake), {"with sleep", asleep}})
    bars.add(fmt::format("wall of 10 000, settled, {}: at most 5 x Box2D", name), 5,
             m && rigid != tables.box2d.end() ? std::optional(m->mean / rigid->settled) : std::nullopt,
             three_digits);
  for (const Which& which : {dynamic, settling}) {
    Which two = which;
    two.threads = 2;
    const auto one_thread = find(tables.threads, which, 1e5), two_threads = find(tables.threads, two, 1e5);
    const auto others = [](const Measurement& m) { return m.total - m.factorization; };
    bars.add(
        fmt::format("two threads, 1e5 blocks, steps of {} s: at least 1.6 x but for the factorization",
                    which.time_step),
        1 / 1.6,
        one_thread && two_threads ? std::optional(others(*two_threads) / others(*one_thread)) : std::nullopt,
        [](double ratio) { return fmt::format("{:.2f}", 1 / ratio); });
  }
  return bars.table();
}

}  // namespace step_performance
