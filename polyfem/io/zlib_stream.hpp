/// \file Bytes as one zlib stream, which browsers inflate too.
#pragma once

#include <string>
#include <string_view>

namespace polyfem {

/// A zlib stream (RFC 1950) of the bytes, at zlib's usual trade of size against time.
std::string zlib_stream(std::string_view bytes);

}  // namespace polyfem
