/// \file Makes doc/verification/mechanics.md and its pictures: `mechanics_verification DIRECTORY [chapter]`.
#include "chapter_page.hpp"
#include "mechanics_chapters.hpp"

namespace {

constexpr const char* front = R"(# Mechanics, against known answers

Made by `bash doc/verification/make.sh`; every number, picture and yes or no below is computed by it. Blocks, contacts and time
scheme are those of `preset = "default"` unless said otherwise: corotational blocks, the staged contact method and the
scheme `decaying`. Rock has 2500 kg/m3, E = 35 GPa and Poisson's ratio 0.3; gravity is 9.8 m/s2. Errors are relative unless they have a
unit. Run times are of one run on one core and rough. Of {} checks {} pass.
)";

constexpr verification::Chapter chapters[] = {{"spinning", verification::spinning},
                                              {"tumbling", verification::tumbling},
                                              {"sliding", verification::sliding_over_steps},
                                              {"colliding", verification::colliding},
                                              {"resting", verification::resting},
                                              {"resting_long", verification::resting_long, true},
                                              {"toppling", verification::toppling},
                                              {"ledger", verification::energy_ledger},
                                              {"schemes", verification::choice_of_scheme},
                                              {"far", verification::far_from_the_origin}};

}  // namespace

int main(int argc, char** argv) {
  return verification::make_page(argc, argv, "mechanics", front, chapters);
}
