/// \file Bytes as zlib streams (RFC 1950), by libdeflate.
#pragma once

#include <libdeflate.h>

#include <memory>
#include <new>
#include <string>

namespace polyfem {

/// What makes them; one thread at a time.
class Compressor {
 public:
  /// \param[in] level  0: bytes as they are; 1: quick; 12: small
  explicit Compressor(int level) : own_(libdeflate_alloc_compressor(level), libdeflate_free_compressor) {
    if (!own_) throw std::bad_alloc();
  }
  /// Appends the stream of these bytes.
  void append(const void* bytes, std::size_t size, std::string& to) const {
    const std::size_t begin = to.size(), most = libdeflate_zlib_compress_bound(own_.get(), size);
    to.resize(begin + most);
    to.resize(begin + libdeflate_zlib_compress(own_.get(), bytes, size, to.data() + begin, most));
  }

 private:
  std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> own_;
};

}  // namespace polyfem
