#include <gtest/gtest.h>
#include <polyfem/core/error.hpp>
#include <polyfem/io/zlib_blocks.hpp>

#include <cstdint>
#include <cstring>
#include <random>

using namespace polyfem;

namespace {

using Bytes = std::vector<std::byte>;

/// Bytes that repeat, that do not, and both in turns, so that every way to deflate is taken.
Bytes sample(std::size_t size, int kind) {
  std::mt19937 random(7);
  Bytes bytes(size);
  for (std::size_t k = 0; k < size; ++k) {
    const bool repeats = kind == 0 || (kind == 2 && (k >> 19) % 2 == 0);
    bytes[k] = std::byte(repeats ? (k / 3) % 11 : random() & 255);
  }
  return bytes;
}

TEST(ZlibBlocks, AnyNumberOfThreadsGivesTheSameBytes) {
  BlockDeflater one(1), two(2), many(7);
  for (std::size_t size : {0, 1, 32769, 524289, 5000003})
    for (int kind : {0, 1, 2}) {
      const Bytes bytes = sample(size, kind);
      const std::string expected = one.deflate(bytes);
      EXPECT_EQ(two.deflate(bytes), expected) << size << " bytes of kind " << kind;
      EXPECT_EQ(many.deflate(bytes), expected) << size << " bytes of kind " << kind;
    }
}

TEST(ZlibBlocks, InflateGivesTheBytesBack) {
  BlockDeflater deflater;
  for (std::size_t size : {0, 1, 8, 4095, 4096, 32767, 32768, 32769, 65536, 2000003})
    for (int kind : {0, 1, 2}) {
      const Bytes bytes = sample(size, kind);
      EXPECT_EQ(inflate_blocks(deflater.deflate(bytes)), bytes) << size << " of kind " << kind;
    }
}

/// VTK's own description of the form: what other readers go by.
TEST(ZlibBlocks, HeaderHoldsNumberAndSizesOfBlocks) {
  const std::string data = BlockDeflater().deflate(sample(70000, 0));
  std::uint64_t header[6];
  std::memcpy(header, data.data(), sizeof header);
  EXPECT_EQ(header[0], 3u);
  EXPECT_EQ(header[1], 32768u);
  EXPECT_EQ(header[2], 70000u - 2 * 32768u);
  EXPECT_EQ(sizeof header + header[3] + header[4] + header[5], data.size());
}

TEST(ZlibBlocks, WhatRepeatsShrinksAndNoiseDoesNotGrow) {
  BlockDeflater deflater;
  EXPECT_LT(deflater.deflate(sample(1000000, 0)).size(), 100000u);
  EXPECT_LT(deflater.deflate(sample(1000000, 1)).size(), 1002000u);
}

TEST(ZlibBlocks, DamageIsAnErrorOrLeavesTheBytesAlone) {
  const Bytes bytes = sample(100000, 2);
  const std::string whole = BlockDeflater().deflate(bytes);
  for (std::size_t size = 0; size < whole.size(); size += 1 + size / 9)
    EXPECT_THROW(inflate_blocks(whole.substr(0, size)), Error) << size;
  std::mt19937 random(3);
  for (int k = 0; k < 3000; ++k) {
    std::string damaged = whole;
    // Half of the flips in the header, where sizes are.
    const std::size_t at = random() % (k % 2 == 0 ? 56 : damaged.size());
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << (random() % 8)));
    try {
      const Bytes result = inflate_blocks(damaged);
      EXPECT_LE(result.size(), bytes.size());
    } catch (const Error&) {
    }
  }
}

}  // namespace
