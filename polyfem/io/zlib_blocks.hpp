/// \file Bytes deflated in blocks, the way VTK keeps arrays in its XML files.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace polyfem {

/// Deflates arrays. Their form is: number of blocks, size of a block, size of the last one when it is smaller
/// (else 0), the deflated size of each block, all UInt64, then the blocks as zlib streams.
///
/// Numbers with all their digits hardly repeat: looking for repetitions (zlib's level 1) takes twice the time
/// of run lengths and codes for bytes, and gains little. So one block in sixteen is deflated both ways, and
/// the next ones as it turned out for that; what shrinks by less than a sixth either way, and an array of
/// less than a block's eighth, is stored. Each such group of blocks is deflated by itself, so that the bytes
/// are the same for any number of threads.
class BlockDeflater {
 public:
  explicit BlockDeflater(int n_threads = 1);
  ~BlockDeflater();
  BlockDeflater(BlockDeflater&&) noexcept;
  BlockDeflater& operator=(BlockDeflater&&) noexcept;

  std::string deflate(std::span<const std::byte> array);

 private:
  struct Streams;
  std::vector<std::unique_ptr<Streams>> streams_;  ///< one a thread
};

/// The bytes that `data` starts with an array of. Throws Error when it does not hold them whole.
std::vector<std::byte> inflate_blocks(std::string_view data);

}  // namespace polyfem
