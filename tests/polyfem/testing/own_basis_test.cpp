// The example's basis of one's own does what it promises.
#define main example_main  // of the example, which is a program
#include <examples/own_basis.cpp>
#undef main

#include <polyfem/testing/basis_properties.hpp>

namespace {

struct PiecewiseLinearPromises {
  static const Basis& basis() {
    static const PiecewiseLinear basis;
    return basis;
  }
  static BasisPromises promises() { return {.shapes = SampleShapes::convex, .affine = true}; }
};
INSTANTIATE_TYPED_TEST_SUITE_P(PiecewiseLinear, BasisProperties, PiecewiseLinearPromises);

}  // namespace
