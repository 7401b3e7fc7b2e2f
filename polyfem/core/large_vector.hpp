/// \file Arrays of many megabytes.
#pragma once

#include <sys/mman.h>

#include <cstddef>
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
    void* const memory =
        mmap(nullptr, n * sizeof(T), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
    madvise(memory, n * sizeof(T), MADV_HUGEPAGE);
#endif
    return static_cast<T*>(memory);
  }
  /// Numbers that are given no value are the zeros of fresh pages, which need no memory until they are
  /// touched: a vector of these is made in its size and does not grow again.
  void construct(T*) {}
  template <class... Arguments>
  void construct(T* at, Arguments&&... arguments) {
    new (at) T(std::forward<Arguments>(arguments)...);
  }
  void deallocate(T* memory, std::size_t n) {
    munmap(memory, n * sizeof(T));
  }

  template <class U>
  bool operator==(const LargePages<U>&) const {
    return true;
  }
};

/// For arrays of megabytes; small ones waste most of a page.
template <class T>
using LargeVector = std::vector<T, LargePages<T>>;

}  // namespace polyfem
