/// \file Makes doc/verification/paper.md and its pictures: `paper_verification DIRECTORY`.
#include "chapters.hpp"

#include <fmt/format.h>
#include <polyfem/assembly/blas.hpp>

#include <exception>

namespace {

constexpr const char* front = R"(# The paper's examples, side by side

Made by `bash doc/verification/make.sh`; every number, picture and yes or no below is computed by it from the scenes in
[examples/paper](../../examples/paper), with `preset = "paper"`: Wachspress blocks as in Jiang et al. (2018), and the
original DDA (`block_model = "affine"`). The text says what the paper says of its figures and whether it is seen here. The paper does
not print the dimensions of its blocks, the contact stiffness, or its Voronoi cells, so shapes, signs and ratios are
compared, not single values. Of {} statements {} are seen.
)";

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: paper_verification DIRECTORY\n");
    return 2;
  }
  try {
    polyfem::pin_blas_to_one_thread();
    verification::Report report(argv[1], "the paper says");
    verification::sliding_block(report);
    verification::arch_bridge(report);
    verification::voronoi_slope(report);
    report.write("paper", fmt::format(front, report.n_claims(), report.n_seen()));
  } catch (const std::exception& error) {
    fmt::print(stderr, "paper_verification: error: {}\n", error.what());
    return 1;
  }
  return 0;
}
