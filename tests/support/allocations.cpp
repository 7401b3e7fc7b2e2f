#include <tests/support/allocations.hpp>

#include <atomic>
#include <cstddef>

#ifdef __SANITIZE_ADDRESS__

long support::n_allocations() {
  return -1;
}

#else

namespace {

std::atomic<long> n_calls{0};

}  // namespace

extern "C" {
void* __libc_malloc(std::size_t size) noexcept;  // glibc's own

void* malloc(std::size_t size) noexcept {
  n_calls.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}
}

long support::n_allocations() {
  return n_calls.load(std::memory_order_relaxed);
}

#endif
