// What cutting a domain by two joint sets takes, in the library alone:
//     cutting_performance
// 320 x 320 m, spacings of 1 m: 103 189 blocks. The median of five.
#include <ddacontact/domain/domain_cutting.hpp>
#include <polyfem/core/stopwatch.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>

using namespace ddacontact;

int main() {
  Domain domain;
  domain.boundary.resize(2, 4);
  domain.boundary << 0, 320, 320, 0, 0, 0, 320, 320;
  domain.joint_sets = {{.joint = 0, .angle = 20, .spacing = 1}, {.joint = 0, .angle = -70, .spacing = 1}};
  std::array<double, 5> seconds{};
  std::size_t n_blocks = 0;
  for (double& of_one : seconds) {
    const polyfem::Stopwatch watch(of_one);
    n_blocks = cut_domain(domain).blocks.size();
  }
  std::ranges::sort(seconds);
  fmt::print("{} blocks in {:.1f} s\n", n_blocks, seconds[seconds.size() / 2]);
}
