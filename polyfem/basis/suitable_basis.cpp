#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/geometry/validity.hpp>

namespace polyfem {

const Basis& suitable_basis(const PointsRef& polygon) {
  if (find_non_convex_corner(polygon, least_wachspress_turn)) return mean_value;
  return wachspress;
}

}  // namespace polyfem
