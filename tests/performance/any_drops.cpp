// Drops of random polygons of any shape: how far blocks overlap, and whether anything passes through
// anything.
//   any_drops FIRST COUNT   runs the drops of these seeds, a line for each, so that many can be run in pieces
//   any_drops table         reads such lines and writes what they come to, in Markdown
#include <tests/support/any_drops.hpp>

#include <polyfem/core/stopwatch.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <map>
#include <sstream>
#include <vector>

namespace {

using namespace support;

void run_drops(std::uint64_t first, std::uint64_t count) {
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    double seconds = 0;
    AnyDrop d;
    {
      const polyfem::Stopwatch watch(seconds);
      d = run_any_drop(seed);
    }
    const std::string what = d.stopped_by.empty() ? d.failure : "stopped: " + d.stopped_by + "; " + d.failure;
    std::printf("%llu %ld %ld %ld %ld %ld %ld %.3g %.3g %d %d %.4f %s\n",
                static_cast<unsigned long long>(seed), d.blocks, d.steps, d.substeps, d.rejected,
                d.overlap_rejections, d.rises, d.overlap, d.rise, d.passed, !d.stopped_by.empty(), seconds,
                what.c_str());
    std::fflush(stdout);
  }
}

struct Sum {
  long drops = 0, blocks = 0, steps = 0, substeps = 0, rejected = 0, overlap_rejections = 0, rises = 0,
       passed = 0, stopped = 0, overlapping = 0;
  double overlap = 0, rise = 0, seconds = 0;
};

bool print_table(std::istream& lines) {
  std::map<std::string, Sum> sums;
  std::vector<std::string> failures;
  std::uint64_t least = ~std::uint64_t{0}, most = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream in(line);
    std::uint64_t seed;
    AnyDrop d;
    bool stopped;
    double seconds;
    if (!(in >> seed >> d.blocks >> d.steps >> d.substeps >> d.rejected >> d.overlap_rejections >> d.rises >>
          d.overlap >> d.rise >> d.passed >> stopped >> seconds))
      return false;
    least = std::min(least, seed);
    most = std::max(most, seed);
    std::getline(in >> std::ws, d.failure);
    if (!d.failure.empty()) failures.push_back(std::to_string(seed) + ": " + d.failure);
    for (const std::string& name : {name_of(ground_of(seed)), std::string("~all")}) {
      Sum& sum = sums[name];
      ++sum.drops;
      sum.blocks += d.blocks;
      sum.steps += d.steps;
      sum.substeps += d.substeps;
      sum.rejected += d.rejected;
      sum.overlap_rejections += d.overlap_rejections;
      sum.rises += d.rises;
      sum.passed += d.passed;
      sum.stopped += stopped;
      sum.overlapping += d.overlap > overlap_limit;
      sum.overlap = std::max(sum.overlap, d.overlap);
      sum.rise = std::max(sum.rise, d.rise);
      sum.seconds += seconds;
    }
  }
  std::printf(
      "# Drops of polygons of any shape\n\nTwo to six random simple polygons, convex and concave, of sizes "
      "1:30, fall in a closed box on fixed ground. %ld drops, of the seeds %llu to %llu: "
      "`build/tests/performance/any_drops FIRST COUNT >> lines; any_drops table < lines`. Overlap is the "
      "largest common area of two blocks relative to the smaller one, after every step; too much is more "
      "than %g. Passed is a drop in which a block's centre was out of the box, or most of a block in "
      "another. Stopped is a run that ended early. A rise is a step after which kinetic, elastic and "
      "potential energy together are larger by more than %g of the largest kinetic energy so far.\n\n| "
      "ground | drops | blocks | steps | substeps | rejected | for overlap | stopped | passed | too much "
      "overlap | overlap | rises | largest | ms a drop "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      sums["~all"].drops, static_cast<unsigned long long>(least), static_cast<unsigned long long>(most),
      overlap_limit, energy_rise);
  for (const auto& [name, s] : sums)
    std::printf("| %s | %ld | %ld | %ld | %ld | %ld | %ld | %ld | %ld | %ld | %.1e | %ld | %.1e | %.0f |\n",
                name == "~all" ? "all" : name.c_str(), s.drops, s.blocks, s.steps, s.substeps, s.rejected,
                s.overlap_rejections, s.stopped, s.passed, s.overlapping, s.overlap, s.rises, s.rise,
                1e3 * s.seconds / static_cast<double>(s.drops));
  if (!failures.empty()) std::printf("\nSeeds that failed:\n\n");
  for (const std::string& failure : failures) std::printf("- %s\n", failure.c_str());
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  if (argc == 3) {
    run_drops(std::strtoull(argv[1], nullptr, 10), std::strtoull(argv[2], nullptr, 10));
    return 0;
  }
  if (argc == 2 && what == "table") return print_table(std::cin) ? 0 : 1;
  std::cerr << "any_drops FIRST COUNT | any_drops table\n";
  return 2;
}
