#include <polyfem/assembly/blas.hpp>
#include <polyfem/core/out_of_memory.hpp>

#include <dlfcn.h>
#include <sys/mman.h>

#include <cstddef>

namespace polyfem {
namespace {

/// A function of whatever BLAS the program was linked or loaded with, or null.
template <class Function>
Function* loaded(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

/// True; throws where it would not be.
bool there_is_room_for_the_buffer(std::size_t beside) {
  if (!loaded<char*()>("openblas_get_config")) return true;
  const std::size_t size = (std::size_t{128} << 20) + beside;
  void* const slot = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (slot == MAP_FAILED) throw OutOfMemory("not enough memory for the 128 MB that OpenBLAS works in");
  munmap(slot, size);
  return true;
}

}  // namespace

std::string pin_blas_to_one_thread() {
  const auto set_num_threads = loaded<void(int)>("openblas_set_num_threads");
  const auto get_config = loaded<char*()>("openblas_get_config");
  const auto get_corename = loaded<char*()>("openblas_get_corename");
  if (!set_num_threads || !get_config || !get_corename) return "unknown (slow?)";
  set_num_threads(1);
  return std::string(get_config()) + ", core " + get_corename();
}

void expect_room_for_blas(std::size_t beside) {
  [[maybe_unused]] static const bool there_is = there_is_room_for_the_buffer(beside);
}

}  // namespace polyfem
