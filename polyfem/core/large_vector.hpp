/// \file Arrays of many megabytes.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <utility>
#include <vector>

namespace polyfem {

/// Memory in pages of two megabytes where the system has them: taking four kilobytes at a time costs as much
/// as what is computed in them.
template <class T>
struct LargePages {
  using value_type = T;

  LargePages() = default;
  template <class U>
  LargePages(const LargePages<U>&) {}

  T* allocate(std::size_t n) {
    void* const memory = std::calloc(n, sizeof(T));
    if (!memory) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
    constexpr std::uintptr_t page = 1 << 21;
    const auto at = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t begin = (at + page - 1) / page * page, end = (at + n * sizeof(T)) / page * page;
    if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#endif
    return static_cast<T*>(memory);
  }
  /// Numbers that are given no value are zeros, whose pages need no memory until they are touched: a vector
  /// of these is made in its size and does not grow again.
  void construct(T*) {}
  template <class... Arguments>
  void construct(T* at, Arguments&&... arguments) {
    new (at) T(std::forward<Arguments>(arguments)...);
  }
  void deallocate(T* memory, std::size_t) {
    std::free(memory);
  }

  template <class U>
  bool operator==(const LargePages<U>&) const {
    return true;
  }
};

/// Of any size; pages of two megabytes are those inside it.
template <class T>
using LargeVector = std::vector<T, LargePages<T>>;

}  // namespace polyfem
