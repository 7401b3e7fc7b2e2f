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
/// Where the first block of sixteen shrinks by less than a sixth the others are stored as they are, and so is an
/// array of less than a block's eighth. Each such group of blocks is deflated by itself, so that the bytes are
/// the same for any number of threads.
class BlockDeflater {
 public:
  explicit BlockDeflater(int n_threads = 1);
  ~BlockDeflater();
  BlockDeflater(BlockDeflater&&) noexcept;
  BlockDeflater& operator=(BlockDeflater&&) noexcept;

  std::string deflate(std::span<const std::byte> array);

 private:
  struct Compressors;
  std::vector<std::unique_ptr<Compressors>> compressors_;  ///< one a thread
};

/// The bytes that `data` starts with an array of. Throws Error when it does not hold them whole.
std::vector<std::byte> inflate_blocks(std::string_view data);

}  // namespace polyfem
