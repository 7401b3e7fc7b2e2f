#include <ddacontact/block/water_pressure.hpp>

#include <algorithm>
#include <cassert>

namespace ddacontact {

namespace {

/// Of a pressure along an edge that is linear from p at a to q at b, fractions of the edge: its integral, and
/// that of itself times the fraction.
struct Moments {
  double whole = 0, first = 0;

  void add(double a, double p, double b, double q) {
    whole += (b - a) * (p + q) / 2;
    first += (b - a) * (p * (2 * a + b) + q * (a + 2 * b)) / 6;
  }
  /// The part of it that is positive.
  void add_positive(double a, double p, double b, double q) {
    if (p <= 0 && q <= 0) return;
    const double crossing = a + (b - a) * p / (p - q);
    if (p < 0)
      add(crossing, 0, b, q);
    else if (q < 0)
      add(a, p, crossing, 0);
    else
      add(a, p, b, q);
  }
};

}  // namespace

EdgeForces water_forces(const Points& table, double unit_weight, const Vec2& start, const Vec2& end,
                        double from, double to) {
  assert(0 <= from && from <= to && to <= 1);
  const Vec2 edge = end - start, inward(-edge.y(), edge.x());  // times the edge's length
  Moments pressure;
  for (Index i = -1; i < table.cols(); ++i) {  // between points i and i + 1 of the table, and beyond its ends
    const bool before = i < 0, after = i + 1 == table.cols();
    const double left = before ? -inf : table(0, i), right = after ? inf : table(0, i + 1);
    double a = from, b = to;
    if (edge.x() != 0) {
      const double at_left = (left - start.x()) / edge.x(), at_right = (right - start.x()) / edge.x();
      a = std::max(a, std::min(at_left, at_right));
      b = std::min(b, std::max(at_left, at_right));
    } else if (start.x() < left || start.x() >= right) {
      continue;
    }
    if (a >= b) continue;
    const Vec2 point = table.col(before ? 0 : i);
    const double slope = before || after ? 0 : (table(1, i + 1) - point.y()) / (right - left);
    const auto depth = [&](double s) {
      const Vec2 x = start + s * edge;
      return point.y() + slope * (x.x() - point.x()) - x.y();
    };
    pressure.add_positive(a, unit_weight * depth(a), b, unit_weight * depth(b));
  }
  return {(pressure.whole - pressure.first) * inward, pressure.first * inward};
}

}  // namespace ddacontact
