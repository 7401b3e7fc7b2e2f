/// \file Bytes of a page: whole numbers in few bytes, and bytes as text.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace ddacontact {

/// Appends a number of either sign: zigzag (0, -1, 1, -2, ...), seven bits a byte from the lowest on, the
/// eighth bit set where more follow.
void append_integer(std::int32_t number, std::string& bytes);

/// Base64 (RFC 4648) with padding.
std::string base64(std::string_view bytes);

}  // namespace ddacontact
