/// \file Makes doc/verification/blocks.md and its pictures: `blocks_verification DIRECTORY [chapter]`.
#include "blocks_chapters.hpp"

#include <fmt/format.h>
#include <polyfem/assembly/blas.hpp>

#include <exception>
#include <string>

namespace {

constexpr const char* front = R"(# Blocks of any shape, against known answers

Made by `bash doc/verification/make.sh`; every number, picture and yes or no below is computed by it. Blocks, contacts and time
scheme are those of `preset = "default"`. Plane strain, thickness 1 m, tension positive. Errors are relative unless they have a
unit. Of {} statements {} are seen.
)";

struct Chapter {
  const char* name;
  void (*write)(verification::Report&);
};
constexpr Chapter chapters[] = {{"bending", verification::bending},
                                {"stress", verification::stress_inside},
                                {"disk", verification::disk},
                                {"shapes", verification::shapes},
                                {"choice", verification::choice}};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 && argc != 3) {
    fmt::print(stderr, "usage: blocks_verification DIRECTORY [chapter]\n");
    return 2;
  }
  try {
    polyfem::pin_blas_to_one_thread();
    verification::Report report(argv[1], "asked");
    for (const Chapter& chapter : chapters)
      if (argc == 2 || chapter.name == std::string(argv[2])) chapter.write(report);
    report.write("blocks", fmt::format(front, report.n_claims(), report.n_seen()));
  } catch (const std::exception& error) {
    fmt::print(stderr, "blocks_verification: error: {}\n", error.what());
    return 1;
  }
  return 0;
}
