#include <polyfem/io/checksum.hpp>

#include <libdeflate.h>

namespace polyfem {

std::uint32_t checksum(std::string_view bytes, std::uint32_t before) {
  return libdeflate_crc32(before, bytes.data(), bytes.size());
}

}  // namespace polyfem
