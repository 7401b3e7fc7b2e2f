#include <ddacontact/page/byte_text.hpp>

namespace ddacontact {

void append_integer(std::int32_t number, std::string& bytes) {
  const auto bits = static_cast<std::uint32_t>(number);
  std::uint32_t left = (bits << 1) ^ (number < 0 ? ~0u : 0u);
  for (; left >= 0x80; left >>= 7) bytes += static_cast<char>((left & 0x7f) | 0x80);
  bytes += static_cast<char>(left);
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  const auto byte = [&](std::size_t k) -> unsigned {
    return k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0;
  };
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const unsigned three = byte(k) << 16 | byte(k + 1) << 8 | byte(k + 2);
    for (std::size_t digit = 0; digit < 4; ++digit)
      text += k + digit > bytes.size() ? '=' : digits[three >> (18 - 6 * digit) & 63];
  }
  return text;
}

}  // namespace ddacontact
