/// \file Makes doc/verification/stability.md: `stability_verification DIRECTORY [chapter]`.
#include "chapters.hpp"

#include <fmt/format.h>
#include <polyfem/assembly/blas.hpp>

#include <exception>
#include <string>

namespace {

constexpr const char* front = R"(# Invariance, robustness and hard scenes

Made by `bash doc/verification/make.sh`; every number below is computed by it, but for those of the long suite.
`build/release/tests/stability/stability_long` (some minutes; `ctest -L long` makes it anew and compares) writes these to
`tests/stability/long.csv`. Scenes of every kind are the paper's examples with the paper's mechanics and the default ones, a drop of
each kind of `tests/support/random_scenes` and `any_drops`, and hard ones of `made_scenes`. They are also a frame of blocks of all
models with supports, loads, bonds and damping by each time scheme, and beams at rest. L is the size of a scene's smallest
free block. Of {} checks
{} pass.

)";

struct Chapter {
  const char* name;
  void (*write)(stability::Page&);
};
constexpr Chapter chapters[] = {{"moving", stability::moving},
                                {"scaling", stability::scaling},
                                {"turning", stability::turning},
                                {"shapes", stability::hard_shapes},
                                {"ratios", stability::ratios},
                                {"incompressible", stability::incompressible},
                                {"time_steps", stability::time_steps},
                                {"spinning", stability::spinning},
                                {"resting", stability::resting},
                                {"slope", stability::slope},
                                {"momentum", stability::momentum},
                                {"contacts", stability::contact_forces},
                                {"drops", stability::drops},
                                {"overlaps", stability::overlaps},
                                {"concave", stability::concave_corners},
                                {"threads", stability::threads},
                                {"interruptions", stability::interruptions}};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 && argc != 3) {
    fmt::print(stderr, "usage: stability_verification DIRECTORY [chapter]\n");
    return 2;
  }
  try {
    polyfem::pin_blas_to_one_thread();
    stability::Page page(argv[1], stability::read_long_record(POLYDDA_LONG_RECORD));
    for (const Chapter& chapter : chapters)
      if (argc == 2 || chapter.name == std::string(argv[2])) chapter.write(page);
    page.write(front);
  } catch (const std::exception& error) {
    fmt::print(stderr, "stability_verification: error: {}\n", error.what());
    return 1;
  }
  return 0;
}
