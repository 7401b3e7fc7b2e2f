#include "chapter_page.hpp"

#include <fmt/format.h>
#include <polyfem/assembly/blas.hpp>

#include <exception>

namespace verification {

int make_page(int argc, char** argv, const std::string& page, const char* front,
              std::span<const Chapter> chapters, const char* claims_of) {
  if (argc != 2 && argc != 3) {
    fmt::print(stderr, "usage: {}_verification DIRECTORY [chapter]\n", page);
    return 2;
  }
  try {
    polyfem::pin_blas_to_one_thread();
    Report report(argv[1], claims_of);
    for (const Chapter& chapter : chapters)
      if (argc == 2 ? !chapter.on_request : chapter.name == std::string(argv[2])) chapter.write(report);
    report.write(page, fmt::format(fmt::runtime(front), report.n_claims(), report.n_seen()));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}_verification: error: {}\n", page, error.what());
    return 1;
  }
  return 0;
}

}  // namespace verification
