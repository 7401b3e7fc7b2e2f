#include <polyfem/io/zlib_blocks.hpp>

#include <polyfem/core/error.hpp>
#include <polyfem/io/compressor.hpp>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <future>

namespace polyfem {
namespace {

static_assert(std::endian::native == std::endian::little, "files are little endian");

constexpr std::size_t block_size = 1 << 15;  // what deflate can see at once; fits a core's cache
constexpr std::size_t blocks_per_trial = 16;
constexpr std::size_t best_possible_ratio = 1032;  // of deflate

std::uint64_t read_number(std::string_view data, std::size_t k) {
  std::uint64_t number = 0;
  if (data.size() / sizeof number <= k) throw Error("it ends too early");
  std::memcpy(&number, data.data() + k * sizeof number, sizeof number);
  return number;
}

struct BlockSizes {
  std::size_t block = 0, n_bytes = 0;
  std::size_t start = 0;  ///< of the first block
  std::vector<std::size_t> deflated;
};

/// Sizes that can be true: a damaged header must not make anyone ask for all memory.
BlockSizes read_sizes(std::string_view data) {
  const std::uint64_t n_blocks = read_number(data, 0), block = read_number(data, 1),
                      last = read_number(data, 2);
  if (n_blocks == 0) return {};
  if (n_blocks > data.size() / sizeof n_blocks || last > block) throw Error("its sizes are damaged");
  BlockSizes sizes{block, 0, (3 + n_blocks) * sizeof n_blocks, {}};
  std::size_t end = sizes.start;
  for (std::uint64_t k = 0; k < n_blocks; ++k) {
    const std::uint64_t deflated = read_number(data, 3 + k),
                        inflated = k + 1 == n_blocks && last > 0 ? last : block;
    if (end > data.size() || deflated > data.size() - end) throw Error("it ends too early");
    if (inflated / best_possible_ratio > deflated) throw Error("its sizes are damaged");
    end += deflated;
    sizes.deflated.push_back(deflated);
    sizes.n_bytes += inflated;
  }
  return sizes;
}

}  // namespace

struct BlockDeflater::Compressors {
  Compressor storing{0}, deflating{1};
};

BlockDeflater::BlockDeflater(int n_threads) : compressors_(std::max(n_threads, 1)) {
  for (auto& compressors : compressors_) compressors = std::make_unique<Compressors>();
}
BlockDeflater::~BlockDeflater() = default;
BlockDeflater::BlockDeflater(BlockDeflater&&) noexcept = default;
BlockDeflater& BlockDeflater::operator=(BlockDeflater&&) noexcept = default;

std::string BlockDeflater::deflate(std::span<const std::byte> array) {
  const std::size_t n_blocks = (array.size() + block_size - 1) / block_size,
                    n_groups = (n_blocks + blocks_per_trial - 1) / blocks_per_trial;
  std::vector<std::uint64_t> header(3 + n_blocks);
  header[0] = n_blocks;
  header[1] = block_size;
  header[2] = array.size() % block_size;
  const bool is_short = array.size() < block_size / 8;

  std::vector<std::string> groups(n_groups);
  const auto deflate_group = [&](std::size_t group, const Compressors& by) {
    const std::size_t first = group * blocks_per_trial, end = std::min(n_blocks, first + blocks_per_trial);
    groups[group].reserve((end - first) * (block_size + 64));
    bool stores = is_short;
    for (std::size_t k = first; k < end; ++k) {
      const auto block = array.subspan(k * block_size, std::min(block_size, array.size() - k * block_size));
      const std::size_t before = groups[group].size();
      (stores ? by.storing : by.deflating).append(block.data(), block.size(), groups[group]);
      header[3 + k] = groups[group].size() - before;
      if (k == first) stores = stores || header[3 + k] > block.size() - block.size() / 6;
    }
  };
  const std::size_t n_threads = std::min(compressors_.size(), n_groups);
  const auto deflate_every_nth = [&](std::size_t thread) {
    for (std::size_t group = thread; group < n_groups; group += n_threads)
      deflate_group(group, *compressors_[thread]);
  };
  std::vector<std::future<void>> others;
  for (std::size_t thread = 1; thread < n_threads; ++thread)
    others.push_back(std::async(std::launch::async, deflate_every_nth, thread));
  if (n_threads > 0) deflate_every_nth(0);
  for (std::future<void>& other : others) other.get();

  const std::string_view head(reinterpret_cast<const char*>(header.data()), header.size() * sizeof header[0]);
  std::size_t size = head.size();
  for (const std::string& group : groups) size += group.size();
  std::string out;
  out.reserve(size);
  out += head;
  for (const std::string& group : groups) out += group;
  return out;
}

std::vector<std::byte> inflate_blocks(std::string_view data) {
  const BlockSizes sizes = read_sizes(data);
  std::vector<std::byte> bytes(sizes.n_bytes);
  std::size_t at = 0;
  const char* deflated = data.data() + sizes.start;
  const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> decompressor(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  if (!decompressor) throw std::bad_alloc();
  for (const std::size_t deflated_size : sizes.deflated) {
    const std::size_t inflated = std::min(sizes.block, bytes.size() - at);
    if (libdeflate_zlib_decompress(decompressor.get(), deflated, deflated_size, bytes.data() + at, inflated,
                                   nullptr) != LIBDEFLATE_SUCCESS)
      throw Error("its bytes are damaged");
    at += inflated;
    deflated += deflated_size;
  }
  return bytes;
}

}  // namespace polyfem
