#include <polyfem/assembly/blas.hpp>

#include <dlfcn.h>

namespace polyfem {
namespace {

/// A function of whatever BLAS the program was linked or loaded with, or null.
template <class Function>
Function* loaded(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
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

}  // namespace polyfem
