/// \file Whether bytes are still those that were written.
#pragma once

#include <cstdint>
#include <string_view>

namespace polyfem {

/// CRC-32 of bytes that go on after others of the checksum `before`.
std::uint32_t checksum(std::string_view bytes, std::uint32_t before = 0);

}  // namespace polyfem
