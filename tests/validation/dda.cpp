/// \file Makes doc/verification/dda.md and its pictures: `dda_verification DIRECTORY [chapter]`.
#include "chapters.hpp"

#include <chapter_page.hpp>

namespace {

constexpr const char* front = R"(# Scenes with known answers

Made by `bash doc/verification/make.sh`; every number, picture and yes or no below is computed by it. Scenes have
`preset = "default"` unless said otherwise. Errors are relative unless they have a unit. Run times are processor times of one run
on one core, and rough. Of {} checks {} pass.
)";

constexpr verification::Chapter chapters[] = {{"sliding", validation::sliding},
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
  return verification::make_page(argc, argv, "dda", front, chapters);
}
