/// \file All random slopes: `jointed_rock_all FILE [RECORDED]` (an hour) writes a line for each, see
/// `record_line`; given those recorded before it fails where a slope does no more what it has to.
#include "slope_study.hpp"

#include <fmt/format.h>
#include <polyfem/assembly/blas.hpp>

#include <exception>
#include <fstream>
#include <set>

namespace {

using namespace jointed_rock;

struct Group {
  int n_slopes;
  support::SlopeSize size;
  int n_restated;
};
constexpr Group groups[] = {{200, {20, 60}, 30}, {20, {190, 210}, 0}};

/// What a slope does as it has to, as words with its number.
std::set<std::string> passed(const SlopeResult& result) {
  const std::string slope = fmt::format("slope {} of {} blocks: ", result.seed, result.n_free);
  std::set<std::string> passed;
  if (result.below.verdict == Verdict::moves) passed.insert(slope + "moves below the limit");
  if (result.rough && result.rough->verdict == Verdict::rests)
    passed.insert(slope + "rests where nothing slides");
  if (result.restated && result.restated->same_verdict)
    passed.insert(slope + "the same mirrored and renumbered");
  return passed;
}

int run(const std::string& path, const std::string& recorded) {
  std::ofstream out(path);
  std::set<std::string> now, before;
  for (const Group& group : groups) {
    Slopes slopes(group.size);
    for (int k = 0; k < group.n_slopes; ++k) {
      const SlopeResult result = study(slopes.next(), k < group.n_restated);
      now.merge(passed(result));
      out << record_line(result) << std::endl;
      if (!out) throw Error("cannot write \"" + path + "\"");
    }
  }
  if (recorded.empty()) return 0;
  std::ifstream in(recorded);
  for (std::string line; std::getline(in, line);) before.merge(passed(read_record_line(line)));
  int n_lost = 0;
  for (const std::string& what : before) {
    if (now.contains(what)) continue;
    ++n_lost;
    fmt::print("no more: {}\n", what);
  }
  return n_lost > 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 && argc != 3) {
    fmt::print(stderr, "usage: jointed_rock_all FILE [RECORDED]\n");
    return 2;
  }
  try {
    polyfem::pin_blas_to_one_thread();
    return run(argv[1], argc == 3 ? argv[2] : "");
  } catch (const std::exception& error) {
    fmt::print(stderr, "jointed_rock_all: error: {}\n", error.what());
    return 1;
  }
}
