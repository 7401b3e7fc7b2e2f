#include <polyfem/assembly/blas.hpp>
#include <polyfem/assembly/cholesky.hpp>

#include <gtest/gtest.h>

#include <dlfcn.h>

namespace {

TEST(Blas, RunsOnOneThreadOnceItIsPinned) {
  const polyfem::Cholesky cholesky;  // brings the BLAS with it
  const std::string description = polyfem::pin_blas_to_one_thread();
  EXPECT_FALSE(description.empty());
  if (void* symbol = dlsym(RTLD_DEFAULT, "openblas_get_num_threads")) {
    EXPECT_EQ(reinterpret_cast<int (*)()>(symbol)(), 1);
    EXPECT_NE(description.find("OpenBLAS"), std::string::npos) << description;
    EXPECT_NE(description.find(", core "), std::string::npos) << description;
  } else {
    EXPECT_EQ(description, "unknown (slow?)");
  }
}

}  // namespace
