/// \file Makes doc/verification/blocks.md and its pictures: `blocks_verification DIRECTORY [chapter]`.
#include "blocks_chapters.hpp"
#include "chapter_page.hpp"

namespace {

constexpr const char* front = R"(# Blocks of any shape, against known answers

Made by `bash doc/verification/make.sh`; every number, picture and yes or no below is computed by it. Blocks, contacts and time
scheme are those of `preset = "default"`. Plane strain, thickness 1 m, tension positive. Errors are relative unless they have a
unit. Of {} checks {} pass.
)";

constexpr verification::Chapter chapters[] = {{"bending", verification::bending},
                                              {"stress", verification::stress_inside},
                                              {"disk", verification::disk},
                                              {"shapes", verification::shapes},
                                              {"choice", verification::choice}};

}  // namespace

int main(int argc, char** argv) {
  return verification::make_page(argc, argv, "blocks", front, chapters);
}
