// Error against run time of whole analyses:
//   error_time measure FILE.csv [problem]   runs everything, in some minutes
//   error_time page FILE.csv DIRECTORY      writes the page and its pictures from it
#include <tests/performance/error_time/page.hpp>

#include <fmt/format.h>
#include <polyfem/assembly/blas.hpp>

#include <cstdio>
#include <exception>
#include <string_view>

using namespace error_time;

namespace {

void tell(const Measurement& m) {
  fmt::print("{:<13} {:<15} {:>8g} {:9.2f} ms  error {:.2e} {}\n", m.quantity, m.method, m.setting,
             1e3 * m.seconds, m.error, m.stopped);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view verb = argc > 1 ? argv[1] : "";
  try {
    polyfem::pin_blas_to_one_thread();
    if (verb == "measure" && (argc == 3 || argc == 4))
      write_table(argv[2], measure_all(argc == 4 ? argv[3] : "", tell));
    else if (verb == "page" && argc == 4)
      write_page(argv[3], read_table(argv[2]));
    else {
      fmt::print(stderr, "usage: error_time measure FILE.csv [problem] | page FILE.csv DIRECTORY\n");
      return 2;
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "error_time: error: {}\n", error.what());
    return 1;
  }
  return 0;
}
