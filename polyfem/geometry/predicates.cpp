#include <polyfem/geometry/predicates.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace polyfem {
namespace {

/// A sum of doubles without round-off: components that do not overlap, in order of magnitude (J. R. Shewchuk,
/// "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997).
class ExactSum {
 public:
  void add(double x) {
    for (int i = 0; i < size_; ++i) {
      const double sum = component_[i] + x;
      const double part = sum - component_[i];
      component_[i] = (component_[i] - (sum - part)) + (x - part);
      x = sum;
    }
    component_[size_++] = x;
  }
  void add_product(double x, double y) {
    const double product = x * y;
    add(std::fma(x, y, -product));
    add(product);
  }
  int sign() const {
    for (int i = size_ - 1; i >= 0; --i)
      if (component_[i] != 0) return component_[i] > 0 ? 1 : -1;
    return 0;
  }

 private:
  std::array<double, 12> component_;
  int size_ = 0;
};

int exact_orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
  ExactSum determinant;  // of cross(b - a, c - a), multiplied out: the differences would be rounded
  determinant.add_product(b.x(), c.y());
  determinant.add_product(-b.x(), a.y());
  determinant.add_product(-a.x(), c.y());
  determinant.add_product(-b.y(), c.x());
  determinant.add_product(b.y(), a.x());
  determinant.add_product(a.y(), c.x());
  return determinant.sign();
}

bool within_box(const Vec2& a, const Vec2& b, const Vec2& p) {
  return (p.array() >= a.cwiseMin(b).array()).all() && (p.array() <= a.cwiseMax(b).array()).all();
}

}  // namespace

int orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double left = (b.x() - a.x()) * (c.y() - a.y());
  const double right = (b.y() - a.y()) * (c.x() - a.x());
  const double determinant = left - right;
  constexpr double u = std::numeric_limits<double>::epsilon() / 2;
  const double error_bound =
      (3 + 16 * u) * u * (std::abs(left) + std::abs(right));  // Shewchuk's ccwerrboundA
  if (determinant > error_bound) return 1;
  if (determinant < -error_bound) return -1;
  return exact_orientation(a, b, c);
}

bool on_segment(const Vec2& a, const Vec2& b, const Vec2& p) {
  return within_box(a, b, p) && orientation(a, b, p) == 0;
}

bool segments_intersect(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const int c_side = orientation(a, b, c), d_side = orientation(a, b, d);
  const int a_side = orientation(c, d, a), b_side = orientation(c, d, b);
  if (c_side * d_side < 0 && a_side * b_side < 0) return true;
  return (c_side == 0 && within_box(a, b, c)) || (d_side == 0 && within_box(a, b, d)) ||
         (a_side == 0 && within_box(c, d, a)) || (b_side == 0 && within_box(c, d, b));
}

}  // namespace polyfem
