/// \file Makes doc/verification/paper.md and its pictures: `paper_verification DIRECTORY [chapter]`.
#include "chapter_page.hpp"
#include "chapters.hpp"

namespace {

constexpr const char* front = R"(# The paper's examples, side by side

Made by `bash doc/verification/make.sh`; every number, picture and yes or no below is computed by it from the scenes in
[examples/paper](../../examples/paper), with `preset = "paper"`: Wachspress blocks as in Jiang et al. (2018), and the
original DDA (`block_model = "affine"`). The text says what the paper says of its figures and whether it is seen here. The paper does
not print the dimensions of its blocks, the contact stiffness, or its Voronoi cells, so shapes, signs and ratios are
compared, not single values. Of {} checks {} pass.
)";

constexpr verification::Chapter chapters[] = {{"sliding", verification::sliding_block},
                                              {"arch", verification::arch_bridge},
                                              {"voronoi", verification::voronoi_slope}};

}  // namespace

int main(int argc, char** argv) {
  return verification::make_page(argc, argv, "paper", front, chapters, "the paper says");
}
