#include <polyfem/io/checksum.hpp>

#include <gtest/gtest.h>

#include <string>

/// The check value of CRC-32 in its specification.
TEST(Checksum, IsThatOfTheStandardInPiecesToo) {
  const std::string text = "123456789";
  EXPECT_EQ(polyfem::checksum(text), 0xCBF43926u);
  EXPECT_EQ(polyfem::checksum("56789", polyfem::checksum("1234")), 0xCBF43926u);
  EXPECT_EQ(polyfem::checksum(""), 0u);
}
