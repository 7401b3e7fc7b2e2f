#include "integers_of_bytes.hpp"

#include <ddacontact/page/moment_coder.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using namespace ddacontact;

TEST(MomentCoder, IsReadBackWhateverTheNumbers) {
  std::mt19937 random(1);
  const std::vector<Range> groups{{0, 4}, {4, 1}, {5, 7}};
  for (const int largest : {0, 1, 100, 1 << 28}) {
    std::uniform_int_distribution<std::int32_t> number(-largest, largest), drift(-1, 1);
    MomentCoder coder(groups, 2);
    std::string bytes;
    std::vector<std::vector<std::int32_t>> moments(6, std::vector<std::int32_t>(24));
    for (std::size_t m = 0; m < moments.size(); ++m) {
      for (std::size_t k = 0; k < 24; ++k)
        moments[m][k] = m % 3 == 0 ? number(random) : moments[m - 1][k] + drift(random);
      coder.append(moments[m], bytes);
    }
    std::size_t at = 0;
    std::vector<std::int32_t> read(24, 0);
    for (const auto& moment : moments) {
      support::next_moment(bytes, at, groups, 2, read);
      EXPECT_EQ(read, moment);
    }
    EXPECT_EQ(at, bytes.size());
  }
}

TEST(MomentCoder, TakesOneByteANumberWhereNothingChanges) {
  MomentCoder coder({{0, 3}}, 1);
  std::string bytes;
  coder.append({100000, 200000, 300000}, bytes);
  const std::size_t first = bytes.size();
  coder.append({100000, 200000, 300000}, bytes);
  EXPECT_EQ(bytes.size() - first, 4u);
}

TEST(Quantization, KeepsEachGroupToItsOwnSize) {
  Quantization quantization({{0, 2}, {2, 1}}, 1, {.bits = 10, .floor_bits = 20});
  const std::vector<double> numbers{3.0, -0.001, 0.00321};
  quantization.see(numbers);
  const std::vector<int> exponents = quantization.exponents();
  const std::vector<std::int32_t> multiples = quantization.round(numbers);
  const double size[] = {3.0, 3.0, 0.00321};
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(std::ldexp(multiples[k], exponents[k / 2]), numbers[k], size[k] / 1024 / 2);
}

TEST(Quantization, TellsNothingApartBelowItsFloor) {
  Quantization quantization({{0, 1}, {1, 1}}, 1, {.bits = 10, .floor_bits = 14});
  quantization.see({1.0, 1e-9});
  EXPECT_EQ(quantization.round({1.0, 1e-9})[1], 0);
}

TEST(Quantization, DoesNotExceedTheCoarsestStep) {
  Quantization quantization({{0, 1}}, 1, {.bits = 4, .floor_bits = 4}, {1e-6});
  quantization.see({10});
  EXPECT_LE(std::ldexp(1, quantization.exponents()[0]), 1e-6);
}

}  // namespace
