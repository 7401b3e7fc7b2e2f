// A guard on how much work steps are: counts of fixed scenes against those recorded in a table.
//
//     step_counts TABLE.csv            fails when a count is larger than recorded, by more than a margin
//     step_counts --write TABLE.csv    records the present ones, after they have fallen
//
// The margin allows for last digits that differ from machine to machine and may tip an iteration.
#include <tests/performance/scenes.hpp>
#include <tests/performance/steps/allocations.hpp>

#include <fmt/format.h>
#include <ddacontact/scene/builder.hpp>
#include <polyfem/assembly/blas.hpp>

#include <array>
#include <exception>
#include <fstream>
#include <map>
#include <sstream>
#include <string_view>

using namespace performance;

namespace {

constexpr double margin_ratio = 1.15;
constexpr long margin_extra = 3;
/// A count below this times the recorded one is worth recording anew.
constexpr double fallen = 0.8;

struct FixedRun {
  const char* name;
  const char* scene;
  int size;
  bool settled;
  int warm_steps, steps;
};
constexpr std::array runs{FixedRun{"wall_settling", "wall", 200, false, 0, 5},
                          FixedRun{"wall_settled", "wall", 200, true, 5, 5},
                          FixedRun{"arch_settling", "arch", 30, false, 0, 5},
                          FixedRun{"heap_settling", "heap", 100, false, 0, 3},
                          FixedRun{"loose_heap_falling", "loose_heap", 50, false, 5, 5},
                          FixedRun{"rain", "rain", 200, false, 1, 5},
                          FixedRun{"slope_sliding", "slide", 100, false, 0, 5},
                          FixedRun{"field_with_mover", "field", 50, false, 15, 5}};

/// Over all steps counted.
struct NamedCount {
  const char* name;
  long StepCounts::*count;
};
constexpr std::array counts_of_steps{NamedCount{"substeps", &StepCounts::substeps},
                                     NamedCount{"rejected", &StepCounts::rejected},
                                     NamedCount{"iterations", &StepCounts::contact_iterations},
                                     NamedCount{"linear_solves", &StepCounts::linear_solves},
                                     NamedCount{"factorizations", &StepCounts::factorizations},
                                     NamedCount{"interior_paths", &StepCounts::interior_point_solves},
                                     NamedCount{"augmentations", &StepCounts::augmentations}};

/// By run, then by count.
using Table = std::map<std::string, std::map<std::string, long>>;

std::map<std::string, long> count(const FixedRun& run) {
  Scene scene = make_scene(run.scene, run.size);
  int steps_before = run.warm_steps;
  if (run.settled) {
    settle_first(scene);
    steps_before += scene.stages.front().analysis.steps;
  }
  const BuiltScene built = build(scene);
  Stepper& stepper = *built.stepper;
  const auto step = [&] {
    if (!stepper.step()) throw Error(fmt::format("{} stops: {}", run.name, stepper.stop_reason()));
  };
  for (int k = 0; k < steps_before; ++k) step();
  const StepCounts before = stepper.counts();
  const long analyses = stepper.times().analyses, allocations = step_performance::n_allocations();
  for (int k = 0; k < run.steps; ++k) step();
  std::map<std::string, long> counts;
  counts["allocations"] = step_performance::n_allocations() - allocations;
  for (const NamedCount& named : counts_of_steps)
    counts[named.name] = stepper.counts().*named.count - before.*named.count;
  counts["analyses"] = stepper.times().analyses - analyses;
  counts["contacts"] = stepper.counts().contacts;
  return counts;
}

Table read(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) throw Error(fmt::format("cannot read \"{}\"", path));
  Table table;
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    std::string run, name, value;
    std::getline(fields, run, ',');
    std::getline(fields, name, ',');
    std::getline(fields, value);
    table[run][name] = std::stol(value);
  }
  return table;
}

void write(const std::string& path, const Table& table) {
  std::ofstream file(path, std::ios::binary);
  file << "run,count,recorded\n";
  for (const auto& [run, counts] : table)
    for (const auto& [name, value] : counts) file << run << ',' << name << ',' << value << '\n';
  file.close();
  if (!file) throw Error(fmt::format("cannot write \"{}\"", path));
}

/// Prints what differs; whether nothing rose.
bool compare(const Table& recorded, const Table& present) {
  bool good = true;
  const auto complain = [&](const std::string& text) {
    fmt::print("{}\n", text);
    good = false;
  };
  for (const auto& [run, counts] : present)
    for (const auto& [name, value] : counts) {
      if (!recorded.contains(run) || !recorded.at(run).contains(name)) {
        complain(fmt::format("{}: {} is not in the table", run, name));
        continue;
      }
      const long before = recorded.at(run).at(name);
      const long most = static_cast<long>(margin_ratio * static_cast<double>(before)) + margin_extra;
      if (value > most)
        complain(
            fmt::format("{}: {} {}, recorded were {} (at most {} allowed)", run, value, name, before, most));
      else if (static_cast<double>(value) < fallen * static_cast<double>(before) - margin_extra)
        fmt::print("{}: {} {}, recorded were {}: record it with --write\n", run, value, name, before);
    }
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  const bool writes = argc == 3 && std::string_view(argv[1]) == "--write";
  if (argc != 2 && !writes) {
    fmt::print(stderr, "usage: step_counts [--write] TABLE.csv\n");
    return 2;
  }
  try {
    polyfem::pin_blas_to_one_thread();
    Table present;
    for (const FixedRun& run : runs) present[run.name] = count(run);
    if (writes) {
      write(argv[2], present);
      return 0;
    }
    if (compare(read(argv[1]), present)) return 0;
    fmt::print("steps are more work than they were; where that is meant to be: step_counts --write {}\n",
               argv[1]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "step_counts: error: {}\n", error.what());
  }
  return 1;
}
