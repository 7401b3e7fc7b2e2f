/// \file Makes doc/verification/dda.md and its pictures: `dda_verification DIRECTORY [chapter]`.
#include "chapters.hpp"

#include <fmt/format.h>
#include <polyfem/assembly/blas.hpp>

#include <exception>
#include <string>

namespace {

constexpr const char* front = R"(# Scenes with known answers

Made by `bash doc/verification/make.sh`; every number, picture and yes or no below is computed by it. Scenes have
`preset = "default"` unless said otherwise. Errors are relative unless they have a unit. Run times are processor times of one run
on one core, and rough. Of {} statements {} are seen.
)";

struct Chapter {
  const char* name;
  void (*write)(validation::Report&);
  bool on_request = false;  ///< only when asked for by name: it takes long
};
constexpr Chapter chapters[] = {{"sliding", validation::sliding},
                                {"velocities", validation::velocities},
                                {"newmark", validation::newmark},
                                {"wedge", validation::wedge},
                                {"chart", validation::chart},
                                {"goodman_bray", validation::goodman_bray},
                                {"arch", validation::arch},
                                {"silo", validation::silo},
                                {"column", validation::column},
                                {"rocking", validation::rocking},
                                {"flight", validation::flight},
                                {"colliding", validation::colliding},
                                {"cantilever", validation::cantilever},
                                {"wave", validation::wave}};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 && argc != 3) {
    fmt::print(stderr, "usage: dda_verification DIRECTORY [chapter]\n");
    return 2;
  }
  try {
    polyfem::pin_blas_to_one_thread();
    validation::Report report(argv[1], "asked");
    for (const Chapter& chapter : chapters)
      if (argc == 2 ? !chapter.on_request : chapter.name == std::string(argv[2])) chapter.write(report);
    report.write("dda", fmt::format(front, report.n_claims(), report.n_seen()));
  } catch (const std::exception& error) {
    fmt::print(stderr, "dda_verification: error: {}\n", error.what());
    return 1;
  }
  return 0;
}
