/// \file Makes doc/verification/jointed_rock.md: `jointed_rock_verification DIRECTORY [chapter]`.
#include "chapters.hpp"

#include <chapter_page.hpp>

namespace {

constexpr const char* front = R"(# Jointed rock

Made by `bash doc/verification/make.sh`; every number and yes or no below is computed by it. Rock of 2500 kg/m3 and 35 GPa, joints
closed at the start. The references are limit analyses of rigid blocks, `tests/support/limit_analysis`, in code of
the tests' own. Of {} checks {} pass.
)";

constexpr verification::Chapter chapters[] = {{"flush_joints", jointed_rock::flush_joints},
                                              {"random_slopes", jointed_rock::random_slopes},
                                              {"factors_of_safety", jointed_rock::factors_of_safety},
                                              {"arches_walls", jointed_rock::arches_walls}};

}  // namespace

int main(int argc, char** argv) {
  return verification::make_page(argc, argv, "jointed_rock", front, chapters);
}
