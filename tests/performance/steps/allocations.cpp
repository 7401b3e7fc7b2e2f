#include "allocations.hpp"

#include <atomic>
#include <cstddef>

namespace {

std::atomic<long> n_calls{0};

}  // namespace

#ifdef __SANITIZE_ADDRESS__

long step_performance::n_allocations() {
  return -1;
}

#else

// What glibc's own functions are called behind their names.
extern "C" {
void* __libc_malloc(std::size_t size) noexcept;
void* __libc_calloc(std::size_t n, std::size_t size) noexcept;
void* __libc_realloc(void* memory, std::size_t size) noexcept;

void* malloc(std::size_t size) noexcept {
  n_calls.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}
void* calloc(std::size_t n, std::size_t size) noexcept {
  n_calls.fetch_add(1, std::memory_order_relaxed);
  return __libc_calloc(n, size);
}
void* realloc(void* memory, std::size_t size) noexcept {
  n_calls.fetch_add(1, std::memory_order_relaxed);
  return __libc_realloc(memory, size);
}
}

long step_performance::n_allocations() {
  return n_calls.load(std::memory_order_relaxed);
}

#endif
