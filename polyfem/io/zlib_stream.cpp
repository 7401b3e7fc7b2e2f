#include <polyfem/io/zlib_stream.hpp>

#include <polyfem/io/compressor.hpp>

namespace polyfem {

std::string zlib_stream(std::string_view bytes) {
  constexpr int level_of_zlib = 6;
  std::string stream;
  Compressor(level_of_zlib).append(bytes.data(), bytes.size(), stream);
  return stream;
}

}  // namespace polyfem
