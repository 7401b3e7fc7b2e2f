#include <ddacontact/page/byte_text.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace ddacontact;

TEST(ByteText, Base64IsThatOfTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(ByteText, SmallIntegersTakeOneByte) {
  std::string bytes;
  for (int number = -64; number < 64; ++number) append_integer(number, bytes);
  EXPECT_EQ(bytes.size(), 128u);
  bytes.clear();
  append_integer(std::numeric_limits<std::int32_t>::min(), bytes);
  EXPECT_EQ(bytes, "\xff\xff\xff\xff\x0f");
}

}  // namespace
