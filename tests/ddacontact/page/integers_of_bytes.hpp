/// \file The reading side of pages, as apps/viewer/bytes.ts has it.
#pragma once

#include <ddacontact/core/types.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace support {

/// The next integer of `append_integer`.
inline std::int32_t next_integer(const std::string& bytes, std::size_t& at) {
  std::uint32_t bits = 0;
  for (int shift = 0;; shift += 7) {
    const auto byte = static_cast<unsigned char>(bytes[at++]);
    bits |= static_cast<std::uint32_t>(byte & 0x7f) << shift;
    if (byte < 0x80) break;
  }
  return static_cast<std::int32_t>(bits >> 1) ^ -static_cast<std::int32_t>(bits & 1);
}

/// The next moment of MomentCoder; `numbers` are those of the moment before.
inline void next_moment(const std::string& bytes, std::size_t& at,
                        const std::vector<ddacontact::Range>& groups, int n_components,
                        std::vector<std::int32_t>& numbers) {
  const int mode = bytes[at++];
  const auto n = static_cast<std::size_t>(n_components);
  std::vector<std::int32_t> change(numbers.size());
  for (std::int32_t& number : change) number = next_integer(bytes, at);
  for (const ddacontact::Range& group : groups)
    for (auto k = static_cast<std::size_t>(group.first + 1) * n;
         (mode & 2) != 0 && k < static_cast<std::size_t>(group.end()) * n; ++k)
      change[k] += change[k - n];
  for (std::size_t k = 0; k < change.size(); ++k) numbers[k] = change[k] + ((mode & 1) != 0 ? numbers[k] : 0);
}

}  // namespace support
