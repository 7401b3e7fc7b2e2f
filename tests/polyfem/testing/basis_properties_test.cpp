// The suite a user's basis is put through, for the library's own.
#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/testing/basis_properties.hpp>

using namespace polyfem;

namespace {

struct WachspressPromises {
  static const Basis& basis() { return wachspress; }
  static BasisPromises promises() { return {.affine = true}; }
};
INSTANTIATE_TYPED_TEST_SUITE_P(Wachspress, BasisProperties, WachspressPromises);

struct MeanValuePromises {
  static const Basis& basis() { return mean_value; }
  static BasisPromises promises() { return {.shapes = SampleShapes::simple}; }
};
INSTANTIATE_TYPED_TEST_SUITE_P(MeanValue, BasisProperties, MeanValuePromises);

}  // namespace
